#pragma once
// What has to be right about a mesh file before OpenMesh's readers may see it.
//
// Found in OpenMesh 9.0 (Debian 12), and why every file is walked through first:
// - OFF: no comments, no counts on the OFF line; face colours in a plain OFF are taken for faces; a file cut
//   short is padded with the last values; counts in the header are believed.
// - OBJ: a corner without a vertex number ("f /1 2 3") aborts the program; lines "v" that do not parse are
// left
//   out, which shifts all numbers; faces with fewer than three different corners are left out; material files
//   are opened.
// - PLY: a header cut short loops forever; coordinates stored as double in binary files become zero; 16-bit
//   indices and lists before the face list are misread.
// - STL: triangles with two equal corners are left out; a binary file cut short reads as zeros.
// - All: coordinates are rounded to float; indices out of range, NaN and infinity pass.
// The check refuses what is wrong, with file, line or face, and writes the rest in the plain form that the
// readers get right. Coordinates are kept here in double.

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace coseg {

/// A face that OpenMesh's reader leaves out because it repeats a vertex.
struct LeftOutFace {
    int face = 0;
    std::vector<int> corners;             ///< OBJ: vertex numbers
    std::vector<Eigen::Vector3d> points;  ///< STL: positions
};

struct CheckedMesh {
    std::string extension;  ///< for OpenMesh: "off", "obj", "ply", "stl"
    bool is_binary = false;
    std::string plain;  ///< the file's content in the form that OpenMesh reads right
    std::vector<Eigen::Vector3d>
        vertices;  ///< in the file's order; empty for STL, whose vertices OpenMesh welds
    int face_count = 0;
    std::vector<LeftOutFace> left_out;  ///< ascending by face
};

/// Each throws Error(input) naming path and line (text) or face and vertex (binary). Memory is taken as data
/// is found, never as a header promises. Faces with one or two corners are kept: every face is given a label.
CheckedMesh check_off(std::string_view bytes, const std::string& path);
CheckedMesh check_obj(std::string_view bytes, const std::string& path);
CheckedMesh check_ply(std::string_view bytes, const std::string& path);
CheckedMesh check_stl(std::string_view bytes, const std::string& path);

/// OpenMesh rounds to float, whose range is smaller; coordinates beyond this are refused.
inline constexpr double largest_coordinate = 1e37;

/// Faces may not have more corners than this in all, so that half-edges can be counted in an int.
inline constexpr long long most_corners = 700'000'000;

/// "face 7 refers to vertex 12, but there are 8 vertices (numbered from 0)" etc., for all formats alike.
std::string bad_index(long long face, long long index, long long vertices);

/// What is wrong with a coordinate, or nothing.
std::string bad_coordinate(long long vertex, double value);

}  // namespace coseg
