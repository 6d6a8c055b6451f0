#pragma once
// Makes vertices for a format that repeats a position at every corner.

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

namespace coseg {

/// Coordinates up to here, which are too small for a normal float, count as 0 in most shapes.
inline constexpr double negligible_coordinate = std::numeric_limits<float>::min();

/// Whether two corners are one vertex, that is, have equal coordinates. -0 and what is at most `negligible`
/// count as 0.
bool is_same_position(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      double negligible = negligible_coordinate);

/// Whether the shape is so small that the coordinates which are negligible in others may be its form.
bool is_tiny(const std::vector<Eigen::Vector3d>& vertices);

/// The mesh that `read(negligible)` makes with such a welder: of a tiny shape, with none of its coordinates
/// neglected.
template <class Read>
auto read_welded(Read&& read) {
    auto mesh = read(negligible_coordinate);
    if (is_tiny(mesh.vertices)) mesh = read(0.0);
    return mesh;
}

/// Gives corners at the same position the same vertex. A vertex has the coordinates of the corner that was
/// the first at its position. Time grows with the number of corners, memory with the number of vertices.
class CornerWelder {
  public:
    /// Coordinates up to `negligible` count as 0.
    explicit CornerWelder(double negligible = negligible_coordinate) : negligible_(negligible) {}

    /// 0, 1, ... in the order in which positions are first met. There may be as many as an int can number.
    int number_of(const Eigen::Vector3d& position);

    /// The position of each number. No other function may be called afterwards.
    std::vector<Eigen::Vector3d> take_vertices() { return std::move(vertices_); }

  private:
    [[nodiscard]] std::size_t slot_of(const Eigen::Vector3d& position) const;
    void grow();

    double negligible_;
    std::vector<Eigen::Vector3d> vertices_;
    /// An open-addressed hash table of vertex numbers, -1 where there is none; its size is a power of two,
    /// and at most half of it is taken. It is only looked up, never walked through, so that its order reaches
    /// no result.
    std::vector<int> slots_ = std::vector<int>(1024, -1);
};

}  // namespace coseg
