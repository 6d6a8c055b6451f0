#include "solvers/subspace/mesh_links.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace coseg {
namespace {

using Links = std::vector<std::vector<int>>;

std::vector<std::string> names_of(int meshes) {
    std::vector<std::string> names;
    for (int m = 0; m < meshes; ++m) names.push_back("mesh_" + std::to_string(m));
    return names;
}

int reached_from_first(const Links& links) {
    std::vector<bool> seen(links.size(), false);
    std::vector<int> open = {0};
    seen[0] = true;
    int count = 0;
    while (!open.empty()) {
        const int at = open.back();
        open.pop_back();
        ++count;
        for (const int next : links[static_cast<std::size_t>(at)]) {
            if (seen[static_cast<std::size_t>(next)]) continue;
            seen[static_cast<std::size_t>(next)] = true;
            open.push_back(next);
        }
    }
    return count;
}

TEST(MeshLinks, AllOthersWhereTheLinksReachThem) {
    EXPECT_TRUE(mesh_links(names_of(1), 2, 1).empty());
    EXPECT_TRUE(mesh_links(names_of(9), 8, 1).empty());
    EXPECT_FALSE(mesh_links(names_of(10), 8, 1).empty());
}

TEST(MeshLinks, SymmetricConnectedAndAlmostRegular) {
    for (const int meshes : {4, 11, 41, 300}) {
        for (const int wanted : {2, 3, 8, 16}) {
            if (wanted + 1 >= meshes) continue;
            const Links links = mesh_links(names_of(meshes), wanted, 5);
            ASSERT_EQ(links.size(), static_cast<std::size_t>(meshes));
            std::size_t total = 0;
            for (int m = 0; m < meshes; ++m) {
                const std::vector<int>& of_mesh = links[static_cast<std::size_t>(m)];
                total += of_mesh.size();
                EXPECT_LE(of_mesh.size(), static_cast<std::size_t>(wanted));
                EXPECT_GE(of_mesh.size(), 2U);
                EXPECT_TRUE(std::ranges::is_sorted(of_mesh));
                EXPECT_EQ(std::ranges::adjacent_find(of_mesh), of_mesh.end());
                for (const int other : of_mesh) {
                    EXPECT_NE(other, m);
                    EXPECT_TRUE(std::ranges::binary_search(links[static_cast<std::size_t>(other)], m));
                }
            }
            EXPECT_EQ(reached_from_first(links), meshes) << meshes << " meshes, " << wanted << " links";
            EXPECT_GE(static_cast<double>(total), 0.9 * meshes * wanted);
        }
    }
}

TEST(MeshLinks, ExpandAsARandomRegularGraphDoes) {
    // The second eigenvalue of a random d-regular graph is near 2 sqrt(d - 1) (Friedman 2008); of a ring of
    // cliques or a lattice it is near d.
    const int meshes = 200;
    const int wanted = 12;
    const Links links = mesh_links(names_of(meshes), wanted, 3);
    Eigen::MatrixXd graph = Eigen::MatrixXd::Zero(meshes, meshes);
    for (int m = 0; m < meshes; ++m) {
        for (const int other : links[static_cast<std::size_t>(m)]) graph(m, other) = 1.0;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(graph, Eigen::EigenvaluesOnly);
    EXPECT_LT(solver.eigenvalues()(meshes - 2), 1.15 * 2.0 * std::sqrt(wanted - 1.0));
}

TEST(MeshLinks, FollowNamesAndSeedNotTheOrderOfMeshes) {
    const std::vector<std::string> names = names_of(30);
    const Links links = mesh_links(names, 6, 7);
    std::vector<std::string> reversed(names.rbegin(), names.rend());
    const Links of_reversed = mesh_links(reversed, 6, 7);
    for (std::size_t m = 0; m < names.size(); ++m) {
        std::vector<std::string> linked, linked_reversed;
        for (const int other : links[m]) linked.push_back(names[static_cast<std::size_t>(other)]);
        for (const int other : of_reversed[names.size() - 1 - m])
            linked_reversed.push_back(reversed[static_cast<std::size_t>(other)]);
        std::ranges::sort(linked);
        std::ranges::sort(linked_reversed);
        EXPECT_EQ(linked, linked_reversed);
    }
    EXPECT_NE(links, mesh_links(names, 6, 8));
}

}  // namespace
}  // namespace coseg
