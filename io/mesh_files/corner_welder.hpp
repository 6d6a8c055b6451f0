#pragma once
// Makes vertices for a format that repeats a position at every corner.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace coseg {

/// Whether two corners are one vertex, that is, have equal coordinates. -0 and what is too small for a normal
/// float count as 0.
bool is_same_position(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Gives corners at the same position the same vertex. A vertex has the coordinates of the corner that was
/// the first at its position. Time grows with the number of corners, memory with the number of vertices.
class CornerWelder {
  public:
    /// 0, 1, ... in the order in which positions are first met. There may be as many as an int can number.
    int number_of(const Eigen::Vector3d& position);

    /// The position of each number. No other function may be called afterwards.
    std::vector<Eigen::Vector3d> take_vertices() { return std::move(vertices_); }

  private:
    [[nodiscard]] std::size_t slot_of(const Eigen::Vector3d& position) const;
    void grow();

    std::vector<Eigen::Vector3d> vertices_;
    /// An open-addressed hash table of vertex numbers, -1 where there is none; its size is a power of two,
    /// and at most half of it is taken. It is only looked up, never walked through, so that its order reaches
    /// no result.
    std::vector<int> slots_ = std::vector<int>(1024, -1);
};

}  // namespace coseg
