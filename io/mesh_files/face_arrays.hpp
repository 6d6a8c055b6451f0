#pragma once
// Values of the faces of a mesh that are written with it.

#include <string>
#include <utility>
#include <vector>

namespace coseg {

/// Named arrays of one value per face of the file. The first of `labels` is the part of each face.
struct FaceArrays {
    std::vector<std::pair<std::string, std::vector<int>>> labels;
    std::vector<std::pair<std::string, std::vector<double>>> values;
    /// Of the parts, for formats that name them; a part beyond its end is called part_NUMBER.
    std::vector<std::string> part_names = {};
};

/// The name of a part.
std::string part_name(const FaceArrays& arrays, int part);

/// The part of each of `face_count` faces. Error(internal) naming `path`, the file to be written, if there is
/// no such array or it has another number of values.
const std::vector<int>& parts_of(const FaceArrays& arrays, int face_count, const std::string& path);

}  // namespace coseg
