#include "io/mesh_files/face_arrays.hpp"

#include "src/base/error.hpp"

namespace coseg {

std::string part_name(const FaceArrays& arrays, int part) {
    const auto number = static_cast<std::size_t>(part);
    return number < arrays.part_names.size() ? arrays.part_names[number] : "part_" + std::to_string(part);
}

const std::vector<int>& parts_of(const FaceArrays& arrays, int face_count, const std::string& path) {
    const std::size_t labels = arrays.labels.empty() ? 0 : arrays.labels.front().second.size();
    if (!arrays.labels.empty() && labels == static_cast<std::size_t>(face_count))
        return arrays.labels.front().second;
    throw Error(ExitCode::internal, path + ": " + std::to_string(labels) + " labels for " +
                                        std::to_string(face_count) + " faces");
}

}  // namespace coseg
