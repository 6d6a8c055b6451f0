#include "src/histograms/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

void check_faces(const std::vector<int>& bin_of_face, const std::vector<int>& patch_of_face, int patches,
                 int bins, const Eigen::VectorXd& weights) {
    if (bin_of_face.size() != patch_of_face.size() ||
        weights.size() != static_cast<Eigen::Index>(bin_of_face.size())) {
        throw Error(ExitCode::internal, "a histogram was given " + std::to_string(bin_of_face.size()) +
                                            " bins, " + std::to_string(patch_of_face.size()) +
                                            " patches and " + std::to_string(weights.size()) +
                                            " weights of faces");
    }
    for (std::size_t f = 0; f < bin_of_face.size(); ++f) {
        const bool fits = bin_of_face[f] >= 0 && bin_of_face[f] < bins && patch_of_face[f] >= 0 &&
                          patch_of_face[f] < patches;
        if (fits) continue;
        throw Error(ExitCode::internal, "face " + std::to_string(f) + " has bin " +
                                            std::to_string(bin_of_face[f]) + " of " + std::to_string(bins) +
                                            " and patch " + std::to_string(patch_of_face[f]) + " of " +
                                            std::to_string(patches));
    }
}

Eigen::MatrixXd weight_per_bin(const std::vector<int>& bin_of_face, const std::vector<int>& patch_of_face,
                               int patches, int bins, const Eigen::VectorXd& weights) {
    Eigen::VectorXd patch_weight = Eigen::VectorXd::Zero(patches);
    for (std::size_t f = 0; f < bin_of_face.size(); ++f) {
        patch_weight[patch_of_face[f]] += weights[static_cast<Eigen::Index>(f)];
    }
    Eigen::MatrixXd histogram = Eigen::MatrixXd::Zero(bins, patches);
    for (std::size_t f = 0; f < bin_of_face.size(); ++f) {
        const int p = patch_of_face[f];
        histogram(bin_of_face[f], p) += patch_weight[p] > 0.0 ? weights[static_cast<Eigen::Index>(f)] : 1.0;
    }
    return histogram;
}

void scale_columns(Eigen::MatrixXd& histogram, HistogramScaling scaling) {
    if (scaling == HistogramScaling::counts) return;
    for (Eigen::Index p = 0; p < histogram.cols(); ++p) {
        double total = 0.0;
        for (Eigen::Index b = 0; b < histogram.rows(); ++b) total += histogram(b, p);
        if (!(total > 0.0)) continue;
        histogram.col(p) /= total;
        if (scaling == HistogramScaling::square_root) histogram.col(p) = histogram.col(p).cwiseSqrt();
    }
}

}  // namespace

std::vector<int> bin_of_face(const Eigen::VectorXd& values, const FeatureRange& range) {
    const auto first_inner = range.edges.begin() + 1;
    const auto last_inner = range.edges.end() - 1;
    std::vector<int> bin(at(values.size()));
    for (std::size_t f = 0; f < bin.size(); ++f) {
        const double value = values[static_cast<Eigen::Index>(f)];
        if (!std::isfinite(value)) {
            throw Error(ExitCode::input,
                        "a descriptor of face " + std::to_string(f) +
                            " is not a finite number; check the mesh for extreme coordinates");
        }
        bin[f] = static_cast<int>(std::lower_bound(first_inner, last_inner, value) - first_inner);
    }
    return bin;
}

Eigen::MatrixXd patch_histograms(const std::vector<int>& bin_of_face, const std::vector<int>& patch_of_face,
                                 int patches, int bins, const Eigen::VectorXd& weights,
                                 HistogramScaling scaling) {
    check_faces(bin_of_face, patch_of_face, patches, bins, weights);
    Eigen::MatrixXd histogram = weight_per_bin(bin_of_face, patch_of_face, patches, bins, weights);
    scale_columns(histogram, scaling);
    return histogram;
}

}  // namespace coseg
