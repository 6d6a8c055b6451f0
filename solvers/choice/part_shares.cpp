#include "solvers/choice/part_shares.hpp"

#include <algorithm>
#include <numeric>

#include "solvers/affinity/global_patch_pairs.hpp"
#include "src/base/index.hpp"

namespace coseg {

Eigen::MatrixXd area_shares(const std::vector<int>& labels, int parts, const std::vector<double>& patch_area,
                            const std::vector<int>& mesh_of) {
    const int meshes = mesh_count(mesh_of);
    Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(parts, meshes);
    std::vector<double> mesh_area(at(meshes), 0.0);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        shares(labels[i], mesh_of[i]) += patch_area[i];
        mesh_area[at(mesh_of[i])] += patch_area[i];
    }
    for (int m = 0; m < meshes; ++m) {
        if (mesh_area[at(m)] > 0.0) shares.col(m) /= mesh_area[at(m)];
    }
    return shares;
}

std::vector<double> mean_area_shares(const std::vector<int>& labels, int parts,
                                     const std::vector<double>& patch_area, const std::vector<int>& mesh_of) {
    const Eigen::MatrixXd of_mesh = area_shares(labels, parts, patch_area, mesh_of);
    std::vector<double> shares(at(parts), 0.0);
    for (int m = 0; m < of_mesh.cols(); ++m) {
        for (int p = 0; p < parts; ++p) shares[at(p)] += of_mesh(p, m);
    }
    for (double& share : shares) share /= static_cast<double>(of_mesh.cols());
    return shares;
}

bool is_degenerate_part(double mean_share, int meshes_with_part, int meshes) {
    return mean_share < 0.005 || 2 * meshes_with_part < meshes;
}

bool is_degenerate_part(const Eigen::Ref<const Eigen::RowVectorXd, 0, Eigen::InnerStride<>>& share_of_mesh) {
    const auto with_part = static_cast<int>((share_of_mesh.array() > 0.0).count());
    return is_degenerate_part(share_of_mesh.mean(), with_part, static_cast<int>(share_of_mesh.size()));
}

bool is_degenerate(const Eigen::MatrixXd& shares) {
    for (Eigen::Index p = 0; p < shares.rows(); ++p) {
        if (is_degenerate_part(shares.row(p))) return true;
    }
    return false;
}

std::vector<int> renumbered(const std::vector<int>& labels) {
    std::vector<int> number;
    std::vector<int> result;
    int next = 0;
    for (const int label : labels) {
        if (at(label) >= number.size()) number.resize(at(label) + 1, -1);
        if (number[at(label)] < 0) number[at(label)] = next++;
        result.push_back(number[at(label)]);
    }
    return result;
}

std::vector<int> canonical_labels(const std::vector<int>& labels, int parts,
                                  const std::vector<double>& patch_area, const std::vector<int>& mesh_of) {
    const std::vector<double> shares = mean_area_shares(labels, parts, patch_area, mesh_of);
    std::vector<std::size_t> lowest(shares.size(), labels.size());
    for (std::size_t i = labels.size(); i-- > 0;) lowest[at(labels[i])] = i;
    std::vector<int> order(shares.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        const auto x = at(a);
        const auto y = at(b);
        const bool empty_x = lowest[x] == labels.size();
        const bool empty_y = lowest[y] == labels.size();
        if (empty_x != empty_y) return empty_y;
        if (shares[x] != shares[y]) return shares[x] > shares[y];
        return lowest[x] != lowest[y] ? lowest[x] < lowest[y] : a < b;
    });
    std::vector<int> number(shares.size());
    for (std::size_t k = 0; k < order.size(); ++k) number[at(order[k])] = static_cast<int>(k);
    std::vector<int> renamed(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i) renamed[i] = number[at(labels[i])];
    return renamed;
}

}  // namespace coseg
