#include "solvers/spectral/diffusion_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "solvers/spectral/spectral_embedding.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

void check_input(const FeatureMatrices& features, const DiffusionOptions& options) {
    const std::int64_t patches = features.columns();
    if (patches > options.most) {
        throw Error(ExitCode::usage,
                    "clusters of " + std::to_string(patches) +
                        " patches by descriptors alone need a dense affinity, which is limited to " +
                        std::to_string(options.most) + " patches; use fewer patches");
    }
    if (options.parts < 1 || options.parts > patches)
        throw Error(ExitCode::usage, std::to_string(options.parts) + " parts are asked for, but there are " +
                                         std::to_string(patches) + " patches; ask for fewer parts");
}

/// N x N, without its diagonal's rounding.
Eigen::MatrixXd squared_distances(const FeatureMatrices& features) {
    const Eigen::Index patches = features.columns();
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(patches, patches);
    for (std::size_t h = 0; h < features.size(); ++h) {
        const FeatureMatrices::ConstBlock x = features[h];
        products.noalias() += x.transpose() * x;
    }
    const Eigen::VectorXd squares = products.diagonal();
    Eigen::MatrixXd distances = squares.replicate(1, patches) + squares.transpose().replicate(patches, 1);
    distances = (distances - products - products.transpose()).cwiseMax(0.0);
    distances.diagonal().setZero();
    return distances;
}

SparseRows gaussian_affinity(const Eigen::MatrixXd& squared) {
    const Eigen::Index patches = squared.cols();
    const double pairs =
        static_cast<double>(patches) * static_cast<double>(std::max<Eigen::Index>(patches - 1, 1));
    const double mean = squared.cwiseSqrt().sum() / pairs;
    const double scale = mean > 0.0 ? 0.5 / (mean * mean) : 0.0;
    SparseRows affinity;
    affinity.size = patches;
    affinity.rows = {0, patches};
    for (Eigen::Index i = 0; i < patches; ++i) {
        for (Eigen::Index j = 0; j < patches; ++j) {
            affinity.columns.push_back(static_cast<int>(j));
            affinity.values.push_back(std::exp(-scale * squared(i, j)));
        }
        affinity.offsets.push_back((i + 1) * patches);
    }
    return affinity;
}

/// Columns are patches, rows the coordinates lambda^t psi without the constant one.
Eigen::MatrixXd diffusion_map(const Comm& self, const SparseRows& affinity, const DiffusionOptions& options) {
    const SpectralEmbedding embedding = spectral_embedding(self, affinity, 1, options.parts + 1, {});
    const auto count = static_cast<Eigen::Index>(embedding.eigenvalues.size());
    Eigen::MatrixXd map = Eigen::MatrixXd::Zero(std::max<Eigen::Index>(count - 1, 1), affinity.size);
    for (Eigen::Index c = 1; c < count; ++c) {
        const double stretch = std::pow(embedding.eigenvalues[at(c)], options.time);
        for (std::size_t r = 0; r < embedding.rows.size(); ++r)
            map(c - 1, embedding.rows[r]) = stretch * embedding.coordinates(static_cast<Eigen::Index>(r), c);
    }
    return map;
}

struct Clustering {
    std::vector<int> label;
    double squares = std::numeric_limits<double>::infinity();
};

/// Assigns every point to its nearest centre; returns whether any changed.
bool assign(const Eigen::MatrixXd& points, const Eigen::MatrixXd& centres, Clustering& clustering) {
    bool changed = false;
    clustering.squares = 0.0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
        Eigen::Index nearest = 0;
        clustering.squares += (centres.colwise() - points.col(i)).colwise().squaredNorm().minCoeff(&nearest);
        int& label = clustering.label[at(i)];
        changed = changed || label != static_cast<int>(nearest);
        label = static_cast<int>(nearest);
    }
    return changed;
}

/// Centres far apart, drawn by squared distance (Arthur, Vassilvitskii 2007).
Eigen::MatrixXd spread_centres(const Eigen::MatrixXd& points, int parts, SeededStream& random) {
    Eigen::MatrixXd centres(points.rows(), parts);
    Eigen::VectorXd squares = Eigen::VectorXd::Ones(points.cols());
    for (int k = 0; k < parts; ++k) {
        double left = random.uniform() * squares.sum();
        Eigen::Index pick = 0;
        while (pick + 1 < points.cols() && (left -= squares[pick]) >= 0.0) ++pick;
        centres.col(k) = points.col(pick);
        const Eigen::VectorXd own = (points.colwise() - points.col(pick)).colwise().squaredNorm();
        squares = k == 0 ? own : squares.cwiseMin(own).eval();
    }
    return centres;
}

Clustering one_start(const Eigen::MatrixXd& points, int parts, std::uint64_t seed) {
    constexpr int most_rounds = 100;
    SeededStream random(seed);
    Eigen::MatrixXd centres = spread_centres(points, parts, random);
    Clustering clustering{.label = std::vector<int>(at(points.cols()), -1)};
    for (int round = 0; round < most_rounds && assign(points, centres, clustering); ++round) {
        Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(points.rows(), parts);
        Eigen::VectorXd counts = Eigen::VectorXd::Zero(parts);
        for (Eigen::Index i = 0; i < points.cols(); ++i) {
            const int k = clustering.label[at(i)];
            sums.col(k) += points.col(i);
            counts[k] += 1.0;
        }
        for (int k = 0; k < parts; ++k) {
            if (counts[k] > 0.0) centres.col(k) = sums.col(k) / counts[k];
        }
    }
    return clustering;
}

}  // namespace

std::vector<int> diffusion_clusters(const Comm& comm, const FeatureMatrices& features,
                                    const DiffusionOptions& options) {
    Clustering best;
    agree(comm, [&] {
        check_input(features, options);
        if (!comm.is_root()) return;
        const Comm self(MPI_COMM_SELF);
        const Eigen::MatrixXd points =
            diffusion_map(self, gaussian_affinity(squared_distances(features)), options);
        for (int s = 0; s < options.starts; ++s) {
            const std::uint64_t seed = hash_words({options.seed, static_cast<std::uint64_t>(s)});
            Clustering found = one_start(points, options.parts, seed);
            if (found.squares < best.squares) best = std::move(found);
        }
    });
    broadcast(comm, best.label);
    return best.label;
}

}  // namespace coseg
