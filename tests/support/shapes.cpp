#include "tests/support/shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "src/base/seeded_random.hpp"

namespace coseg::test {

namespace {

TriMesh from_lists(const std::vector<Eigen::Vector3d>& points,
                   const std::vector<Eigen::Vector3i>& triangles) {
    TriMesh mesh;
    mesh.vertices.resize(3, static_cast<Eigen::Index>(points.size()));
    mesh.faces.resize(3, static_cast<Eigen::Index>(triangles.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
        mesh.vertices.col(static_cast<Eigen::Index>(i)) = points[i];
    for (std::size_t i = 0; i < triangles.size(); ++i)
        mesh.faces.col(static_cast<Eigen::Index>(i)) = triangles[i];
    return mesh;
}

void subdivide_on_sphere(std::vector<Eigen::Vector3d>& points, std::vector<Eigen::Vector3i>& triangles) {
    std::map<std::pair<int, int>, int> middle;
    const auto midpoint = [&](int a, int b) {
        const auto [entry, is_new] = middle.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
        if (is_new)
            points.push_back(
                (points[static_cast<std::size_t>(a)] + points[static_cast<std::size_t>(b)]).normalized());
        return entry->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const auto& t : triangles) {
        const int ab = midpoint(t[0], t[1]);
        const int bc = midpoint(t[1], t[2]);
        const int ca = midpoint(t[2], t[0]);
        finer.insert(finer.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
}

}  // namespace

TriMesh sphere(int levels, double radius) {
    const double g = std::numbers::phi;
    std::vector<Eigen::Vector3d> points{{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                        {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                        {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    for (auto& p : points) p.normalize();
    std::vector<Eigen::Vector3i> triangles{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                           {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                           {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                           {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int level = 0; level < levels; ++level) subdivide_on_sphere(points, triangles);
    TriMesh mesh = from_lists(points, triangles);
    mesh.vertices *= radius;
    return mesh;
}

TriMesh box(double x, double y, double z, int cells) {
    const Eigen::Vector3d size(x, y, z);
    Eigen::Vector3i steps;
    for (int k = 0; k < 3; ++k)
        steps[k] = std::max(1, static_cast<int>(std::lround(cells * size[k] / size.maxCoeff())));
    std::map<std::array<int, 3>, int> number;
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3i> triangles;
    const auto vertex = [&](const Eigen::Vector3i& c) {
        const auto [entry, is_new] = number.try_emplace({c[0], c[1], c[2]}, static_cast<int>(points.size()));
        if (is_new)
            points.emplace_back(c.cast<double>().cwiseQuotient(steps.cast<double>()).cwiseProduct(size));
        return entry->second;
    };
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (const bool top : {false, true}) {
            for (int i = 0; i < steps[u]; ++i) {
                for (int j = 0; j < steps[v]; ++j) {
                    const auto corner = [&](int di, int dj) {
                        Eigen::Vector3i c;
                        c[axis] = top ? steps[axis] : 0;
                        c[u] = i + di;
                        c[v] = j + dj;
                        return vertex(c);
                    };
                    const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
                    if (top)
                        triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
                    else
                        triangles.insert(triangles.end(), {{a, c, b}, {a, d, c}});
                }
            }
        }
    }
    return from_lists(points, triangles);
}

TriMesh prism(double radius, double height, int sides) {
    TriMesh mesh;
    mesh.vertices.resize(3, 2 * sides);
    mesh.faces.resize(3, 4 * sides - 4);
    int face = 0;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2.0 * M_PI * i / sides;
        mesh.vertices.col(i) << radius * std::cos(angle), radius * std::sin(angle), 0.0;
        mesh.vertices.col(sides + i) << radius * std::cos(angle), radius * std::sin(angle), height;
        const int j = (i + 1) % sides;
        mesh.faces.col(face++) << i, j, sides + j;
        mesh.faces.col(face++) << i, sides + j, sides + i;
    }
    for (int i = 1; i + 1 < sides; ++i) {
        mesh.faces.col(face++) << 0, i + 1, i;
        mesh.faces.col(face++) << sides, sides + i, sides + i + 1;
    }
    return mesh;
}

TriMesh torus(double major_radius, double minor_radius, int nu, int nv) {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int i = 0; i < nu; ++i) {
        for (int j = 0; j < nv; ++j) {
            const double u = 2 * std::numbers::pi * i / nu;
            const double v = 2 * std::numbers::pi * j / nv;
            const double r = major_radius + minor_radius * std::cos(v);
            points.emplace_back(r * std::cos(u), r * std::sin(u), minor_radius * std::sin(v));
            const int a = i * nv + j, b = (i + 1) % nu * nv + j;
            const int c = (i + 1) % nu * nv + (j + 1) % nv, d = i * nv + (j + 1) % nv;
            triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
        }
    }
    return from_lists(points, triangles);
}

TriMesh flat_square(int n) {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) points.emplace_back(double(i) / n, double(j) / n, 0.0);
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j, b = a + n + 1, c = b + 1, d = a + 1;
            triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
        }
    }
    return from_lists(points, triangles);
}

TriMesh disjoint_union(const TriMesh& a, const TriMesh& b) {
    TriMesh both;
    both.vertices.resize(3, a.vertices.cols() + b.vertices.cols());
    both.vertices << a.vertices, b.vertices;
    both.faces.resize(3, a.faces.cols() + b.faces.cols());
    both.faces << a.faces, (b.faces.array() + a.vertex_count()).matrix();
    return both;
}

TriMesh shuffled_faces(const TriMesh& mesh, unsigned seed, std::vector<int>& order) {
    order.resize(static_cast<std::size_t>(mesh.face_count()));
    std::iota(order.begin(), order.end(), 0);
    SeededStream random(seed);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    TriMesh result = mesh;
    for (int k = 0; k < mesh.face_count(); ++k) {
        const int turn = static_cast<int>(random() % 3);
        for (int c = 0; c < 3; ++c)
            result.faces(c, k) = mesh.faces((c + turn) % 3, order[static_cast<std::size_t>(k)]);
    }
    return result;
}

}  // namespace coseg::test
