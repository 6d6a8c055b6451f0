#include "src/descriptors/shape_context.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "src/base/index.hpp"
#include "src/base/vector_clones.hpp"

namespace coseg {

namespace {

constexpr int radial_edges = static_cast<int>(shape_context_radii.size());
constexpr int angle_edges = shape_context_angles - 1;

/// Centroids and reversed normals of the samples, one array a coordinate, so that loops over samples
/// vectorise.
struct SamplePoints {
    Eigen::MatrixX3f centroid;
    Eigen::MatrixX3f inward;
};

SamplePoints sample_points(const GeodesicTable& table, const Eigen::Matrix3Xd& centroids,
                           const Eigen::Matrix3Xd& normals) {
    const auto samples = static_cast<Eigen::Index>(table.sample_face.size());
    SamplePoints points{Eigen::MatrixX3f(samples, 3), Eigen::MatrixX3f(samples, 3)};
    for (Eigen::Index k = 0; k < samples; ++k) {
        const int face = table.sample_face[at(k)];
        points.centroid.row(k) = centroids.col(face).transpose().cast<float>();
        points.inward.row(k) = -normals.col(face).transpose().cast<float>();
    }
    return points;
}

/// Infinite where the mesh has no extent, so that everything falls into the innermost bin.
std::array<float, radial_edges> radial_thresholds(const GeodesicTable& table) {
    const float largest = table.distance.size() > 0 ? table.distance.maxCoeff() : 0.0F;
    std::array<float, radial_edges> thresholds{};
    for (std::size_t b = 0; b < thresholds.size(); ++b) {
        thresholds[b] = largest > 0.0F ? static_cast<float>(shape_context_radii[b]) * largest
                                       : std::numeric_limits<float>::infinity();
    }
    return thresholds;
}

/// Cosines at the inner edges, descending; the bin of an angle is the number of edges above its cosine.
std::array<float, angle_edges> cosine_thresholds() {
    constexpr double in_plane = 1e-4;
    std::array<float, angle_edges> thresholds{};
    for (int b = 1; b <= angle_edges; ++b) {
        const bool is_middle = 2 * b == shape_context_angles;
        const double cosine = std::cos(std::numbers::pi * b / shape_context_angles);
        thresholds[at(b - 1)] = static_cast<float>(is_middle ? -in_plane : cosine);
    }
    return thresholds;
}

/// Of the vectors c_k - c_i: length, and cosine times length against the face's and against the samples'
/// inward normal.
struct Projections {
    explicit Projections(Eigen::Index samples) : length(samples), on_face(samples), on_sample(samples) {}
    Eigen::VectorXf length;
    Eigen::VectorXf on_face;
    Eigen::VectorXf on_sample;
};

COSEG_VECTOR_CLONES void project_samples(const SamplePoints& points, const Eigen::Vector3f& centre,
                                         const Eigen::Vector3f& inward, Projections& projections) {
    const Eigen::Index samples = points.centroid.rows();
    const float* px = points.centroid.data();
    const float* py = px + samples;
    const float* pz = py + samples;
    const float* nx = points.inward.data();
    const float* ny = nx + samples;
    const float* nz = ny + samples;
    float* length = projections.length.data();
    float* on_face = projections.on_face.data();
    float* on_sample = projections.on_sample.data();
    for (Eigen::Index k = 0; k < samples; ++k) {
        const float x = px[k] - centre[0];
        const float y = py[k] - centre[1];
        const float z = pz[k] - centre[2];
        // Never 0, so that a sample at the centre has a cosine of 0 rather than none.
        length[k] = std::sqrt(x * x + y * y + z * z + 1e-30F);
        on_face[k] = x * inward[0] + y * inward[1] + z * inward[2];
        on_sample[k] = x * nx[k] + y * ny[k] + z * nz[k];
    }
}

struct Thresholds {
    std::array<float, radial_edges> radial;
    std::array<float, angle_edges> cosine;
};

/// Per sample the first of its radial bin's angular ones.
COSEG_VECTOR_CLONES void radial_bins(const Thresholds& thresholds, const float* distance,
                                     Eigen::Index samples, int* bin) {
    for (Eigen::Index k = 0; k < samples; ++k) {
        int radial = 0;
        for (const float edge : thresholds.radial) radial += distance[k] >= edge ? 1 : 0;
        bin[k] = radial * shape_context_angles;
    }
}

COSEG_VECTOR_CLONES void add_angle_bins(const Thresholds& thresholds, const float* along, const float* length,
                                        Eigen::Index samples, const int* radial, int* bin) {
    for (Eigen::Index k = 0; k < samples; ++k) {
        int angle = 0;
        for (const float edge : thresholds.cosine) angle += along[k] < edge * length[k] ? 1 : 0;
        bin[k] = radial[k] + angle;
    }
}

/// Per sample its bin against the face's normal, and against its own.
using BinPair = std::array<Eigen::VectorXi, 2>;

/// Writes `scale` times the samples' weight in each bin, of one kind after the other. Both are added up in
/// one loop: the additions to one bin wait for each other, often those to the next one.
void write_contexts(const BinPair& bin, const Eigen::VectorXd& weight, ShapeContextNormal normal, float scale,
                    float* context) {
    std::array<std::array<double, shape_context_bins>, 2> mass{};
    for (Eigen::Index k = 0; k < weight.size(); ++k) {
        mass[0][at(bin[0][k])] += weight[k];
        mass[1][at(bin[1][k])] += weight[k];
    }
    for (const std::size_t kind : {0U, 1U}) {
        if (normal == (kind == 0 ? ShapeContextNormal::sample : ShapeContextNormal::face)) continue;
        for (const double in_bin : mass[kind]) *context++ = scale * static_cast<float>(in_bin);
    }
}

}  // namespace

Eigen::MatrixXf shape_context(const GeodesicTable& table, const Eigen::Matrix3Xd& centroids,
                              const Eigen::Matrix3Xd& normals, ShapeContextNormal normal) {
    const Eigen::Index samples = table.distance.rows();
    const SamplePoints points = sample_points(table, centroids, normals);
    const Thresholds thresholds{radial_thresholds(table), cosine_thresholds()};
    const bool both = normal == ShapeContextNormal::both;
    const float scale = both ? 0.5F : 1.0F;
    Projections projections(samples);
    Eigen::VectorXi radial(samples);
    BinPair bin{Eigen::VectorXi(samples), Eigen::VectorXi(samples)};
    Eigen::MatrixXf contexts(both ? 2 * shape_context_bins : shape_context_bins, table.distance.cols());
    for (Eigen::Index f = 0; f < contexts.cols(); ++f) {
        project_samples(points, centroids.col(f).cast<float>(), -normals.col(f).cast<float>(), projections);
        radial_bins(thresholds, table.distance.data() + f * samples, samples, radial.data());
        add_angle_bins(thresholds, projections.on_face.data(), projections.length.data(), samples,
                       radial.data(), bin[0].data());
        add_angle_bins(thresholds, projections.on_sample.data(), projections.length.data(), samples,
                       radial.data(), bin[1].data());
        write_contexts(bin, table.sample_weight, normal, scale, contexts.data() + f * contexts.rows());
    }
    return contexts;
}

Eigen::VectorXd shape_context_rings(const Eigen::MatrixXf& contexts) {
    Eigen::VectorXd rings = Eigen::VectorXd::Zero(contexts.cols());
    for (Eigen::Index f = 0; f < contexts.cols(); ++f) {
        double total = 0.0;
        for (Eigen::Index bin = 0; bin < contexts.rows(); ++bin) {
            const Eigen::Index ring = bin % shape_context_bins / shape_context_angles;
            rings[f] += static_cast<double>(ring) * contexts(bin, f);
            total += contexts(bin, f);
        }
        if (total > 0.0) rings[f] /= total;
    }
    return rings;
}

}  // namespace coseg
