#include "src/families/isosurface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int block_cells = 4;

/// Corners and centres of cubic cells, with the field's values there.
struct Lattice {
    Vector3d origin;
    double spacing = 0.0;
    Vector3i cells = Vector3i::Zero();
    std::vector<double> corner_value;
    std::vector<double> centre_value;

    [[nodiscard]] std::size_t corner(int i, int j, int k) const {
        return (at(i) * (cells[1] + 1) + j) * (cells[2] + 1) + k;
    }
    [[nodiscard]] std::size_t centre(int i, int j, int k) const {
        return (at(i) * cells[1] + j) * cells[2] + k;
    }
    [[nodiscard]] Vector3d corner_point(int i, int j, int k) const {
        return origin + spacing * Vector3d(i, j, k);
    }
    [[nodiscard]] Vector3d centre_point(int i, int j, int k) const {
        return origin + spacing * Vector3d(i + 0.5, j + 0.5, k + 0.5);
    }
};

Lattice empty_lattice(const Eigen::AlignedBox3d& box, double spacing) {
    Lattice lattice;
    lattice.spacing = spacing;
    lattice.origin = box.min() - Vector3d::Constant(2.0 * spacing);
    const Vector3d cells = (box.sizes() / spacing).array().ceil() + 4.0;
    if (!(spacing > 0.0) || !(cells.prod() <= double(1 << 27))) {
        throw Error(ExitCode::input,
                    "the lattice for the surface would have more than 2^27 cells; take a larger spacing");
    }
    lattice.cells = cells.cast<int>();
    lattice.corner_value.resize(static_cast<std::size_t>((cells.array() + 1.0).prod()));
    lattice.centre_value.resize(static_cast<std::size_t>(cells.prod()));
    return lattice;
}

/// Values of the points first..last-1 of a block; `far` stands for all of them where it is not zero.
void fill_block(Lattice& lattice, const ScalarField& field, const Vector3i& first, double far) {
    const Vector3i last = (first.array() + block_cells).matrix();
    for (int i = first[0]; i < std::min(last[0], lattice.cells[0] + 1); ++i) {
        for (int j = first[1]; j < std::min(last[1], lattice.cells[1] + 1); ++j) {
            for (int k = first[2]; k < std::min(last[2], lattice.cells[2] + 1); ++k) {
                lattice.corner_value[lattice.corner(i, j, k)] =
                    far != 0.0 ? far : field(lattice.corner_point(i, j, k));
                if (i >= lattice.cells[0] || j >= lattice.cells[1] || k >= lattice.cells[2]) continue;
                lattice.centre_value[lattice.centre(i, j, k)] =
                    far != 0.0 ? far : field(lattice.centre_point(i, j, k));
            }
        }
    }
}

void fill_lattice(Lattice& lattice, const ScalarField& field, double slope) {
    const Vector3d half = Vector3d::Constant(0.5 * block_cells * lattice.spacing);
    // One cell more than the block: an edge that leaves it must not cross the surface either.
    const double safe = slope * (half.norm() + lattice.spacing);
    for (int i = 0; i <= lattice.cells[0]; i += block_cells) {
        for (int j = 0; j <= lattice.cells[1]; j += block_cells) {
            for (int k = 0; k <= lattice.cells[2]; k += block_cells) {
                const double middle = slope > 0.0 ? field(lattice.corner_point(i, j, k) + half) : 0.0;
                fill_block(lattice, field, {i, j, k}, std::abs(middle) > safe ? middle : 0.0);
            }
        }
    }
}

struct LatticePoint {
    std::uint64_t id;
    double value;
    Vector3d position;
};

class TetrahedronMarcher {
  public:
    /// p[0..3] positively oriented.
    void march(const std::array<const LatticePoint*, 4>& p) {
        int inside = 0;
        for (int c = 0; c < 4; ++c) inside |= (p[c]->value < 0.0 ? 1 : 0) << c;
        if (inside == 0 || inside == 15) return;
        static constexpr std::array<std::array<int, 4>, 4> single{
            {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}}};
        static constexpr std::array<std::array<int, 4>, 6> pairs{
            {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};
        for (const auto& s : single) {
            const int bit = 1 << s[0];
            if (inside != bit && inside != (15 ^ bit)) continue;
            const int a = crossing(*p[s[0]], *p[s[1]]);
            const int b = crossing(*p[s[0]], *p[s[2]]);
            const int c = crossing(*p[s[0]], *p[s[3]]);
            if (inside == bit)
                faces_.push_back({a, b, c});
            else
                faces_.push_back({a, c, b});
            return;
        }
        for (const auto& s : pairs) {
            if (inside != ((1 << s[0]) | (1 << s[1]))) continue;
            add_quad(crossing(*p[s[0]], *p[s[2]]), crossing(*p[s[0]], *p[s[3]]), crossing(*p[s[1]], *p[s[3]]),
                     crossing(*p[s[1]], *p[s[2]]));
            return;
        }
    }

    [[nodiscard]] TriMesh mesh() const {
        TriMesh result;
        result.vertices.resize(3, static_cast<Eigen::Index>(points_.size()));
        result.faces.resize(3, static_cast<Eigen::Index>(faces_.size()));
        for (std::size_t v = 0; v < points_.size(); ++v)
            result.vertices.col(static_cast<Eigen::Index>(v)) = points_[v];
        for (std::size_t f = 0; f < faces_.size(); ++f)
            result.faces.col(static_cast<Eigen::Index>(f)) = faces_[f];
        return result;
    }

  private:
    void add_quad(int a, int b, int c, int d) {
        if ((points_[a] - points_[c]).squaredNorm() <= (points_[b] - points_[d]).squaredNorm()) {
            faces_.insert(faces_.end(), {Vector3i(a, b, c), Vector3i(a, c, d)});
        } else {
            faces_.insert(faces_.end(), {Vector3i(a, b, d), Vector3i(b, c, d)});
        }
    }

    int crossing(const LatticePoint& a, const LatticePoint& b) {
        if (a.id > b.id) return crossing(b, a);
        const auto [entry, is_new] =
            number_.try_emplace((a.id << 32U) | b.id, static_cast<int>(points_.size()));
        if (is_new) {
            const double t = std::clamp(a.value / (a.value - b.value), 0.1, 0.9);
            points_.push_back(a.position + t * (b.position - a.position));
        }
        return entry->second;
    }

    std::unordered_map<std::uint64_t, int> number_;  // looked up only, never walked through
    std::vector<Vector3d> points_;
    std::vector<Vector3i> faces_;
};

LatticePoint corner_of(const Lattice& lattice, const Vector3i& c) {
    const std::size_t id = lattice.corner(c[0], c[1], c[2]);
    return {id, lattice.corner_value[id], lattice.corner_point(c[0], c[1], c[2])};
}

LatticePoint centre_of(const Lattice& lattice, const Vector3i& c) {
    const std::size_t id = lattice.centre(c[0], c[1], c[2]);
    return {lattice.corner_value.size() + id, lattice.centre_value[id],
            lattice.centre_point(c[0], c[1], c[2])};
}

bool is_crossed(const Lattice& lattice, const Vector3i& near, const Vector3i& far,
                const std::array<Vector3i, 4>& ring) {
    const bool inside = lattice.centre_value[lattice.centre(near[0], near[1], near[2])] < 0.0;
    if ((lattice.centre_value[lattice.centre(far[0], far[1], far[2])] < 0.0) != inside) return true;
    return std::any_of(ring.begin(), ring.end(), [&](const Vector3i& c) {
        return (lattice.corner_value[lattice.corner(c[0], c[1], c[2])] < 0.0) != inside;
    });
}

/// The four tetrahedra between the centres of two cells and the edges of the square that the cells share.
void march_square(const Lattice& lattice, const Vector3i& cell, int axis, TetrahedronMarcher& marcher) {
    const Vector3i next = cell + Vector3i::Unit(axis);
    const Vector3i u = Vector3i::Unit((axis + 1) % 3);
    const Vector3i v = Vector3i::Unit((axis + 2) % 3);
    const std::array<Vector3i, 4> ring{next, next + u, next + u + v, next + v};
    if (!is_crossed(lattice, cell, next, ring)) return;
    const LatticePoint near = centre_of(lattice, cell);
    const LatticePoint far = centre_of(lattice, next);
    const std::array<LatticePoint, 4> corners{corner_of(lattice, ring[0]), corner_of(lattice, ring[1]),
                                              corner_of(lattice, ring[2]), corner_of(lattice, ring[3])};
    for (std::size_t e = 0; e < 4; ++e) marcher.march({&near, &corners[e], &corners[(e + 1) % 4], &far});
}

void check_surroundings(const Lattice& lattice) {
    const Vector3i n = lattice.cells;
    for (int i = 0; i < n[0]; ++i) {
        for (int j = 0; j < n[1]; ++j) {
            for (int k = 0; k < n[2]; ++k) {
                const bool outer =
                    i == 0 || j == 0 || k == 0 || i + 1 == n[0] || j + 1 == n[1] || k + 1 == n[2];
                if (outer && lattice.centre_value[lattice.centre(i, j, k)] < 0.0) {
                    throw Error(ExitCode::input,
                                "the solid reaches beyond the box given for its surface; widen the box");
                }
            }
        }
    }
}

}  // namespace

TriMesh isosurface(const ScalarField& field, const Eigen::AlignedBox3d& box, double spacing, double slope) {
    Lattice lattice = empty_lattice(box, spacing);
    fill_lattice(lattice, field, slope);
    check_surroundings(lattice);
    TetrahedronMarcher marcher;
    for (int i = 0; i < lattice.cells[0]; ++i) {
        for (int j = 0; j < lattice.cells[1]; ++j) {
            for (int k = 0; k < lattice.cells[2]; ++k) {
                const Vector3i cell(i, j, k);
                for (int axis = 0; axis < 3; ++axis) {
                    if (cell[axis] + 1 < lattice.cells[axis]) march_square(lattice, cell, axis, marcher);
                }
            }
        }
    }
    return marcher.mesh();
}

}  // namespace coseg
