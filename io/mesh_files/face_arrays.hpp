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
};

/// The part of each of `face_count` faces. Error(internal) naming `path`, the file to be written, if there is
/// no such array or it has another number of values.
const std::vector<int>& parts_of(const FaceArrays& arrays, int face_count, const std::string& path);

}  // namespace coseg
