#include "io/mesh_files/unusable_vertices.hpp"

#include <algorithm>

#include "io/mesh_files/mesh_limits.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr int left_out = -1;

std::string left_out_sentence(std::size_t count) {
    return (count == 1 ? std::string("1 vertex that no face uses has")
                       : std::to_string(count) + " vertices that no face uses have") +
           " coordinates that are not finite or beyond 1e37, and " + (count == 1 ? "is" : "are") +
           " left out";
}

}  // namespace

void UnusableVertices::add(std::int64_t vertex, double coordinate, std::int64_t line) {
    if (places_.empty() || places_.back().vertex != vertex) places_.push_back({vertex, coordinate, line});
}

void UnusableVertices::refuse(const Place& place, const std::string& path) {
    const std::string line = place.line > 0 ? ":" + std::to_string(place.line) : "";
    throw Error(ExitCode::input, path + line + ": " + bad_coordinate(place.vertex, place.coordinate));
}

ParsedMesh UnusableVertices::left_out_of(ParsedMesh parsed, const std::string& path) const {
    if (places_.empty()) return parsed;
    PolygonMesh& mesh = parsed.mesh;
    std::vector<char> is_used(mesh.vertices.size(), 0);
    for (const int corner : mesh.corners) is_used[at(corner)] = 1;
    std::vector<int> new_number(mesh.vertices.size(), 0);
    for (const Place& place : places_) {
        if (is_used[at(place.vertex)] != 0) refuse(place, path);
        new_number[at(place.vertex)] = left_out;
    }
    int kept = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        if (new_number[v] == left_out) continue;
        mesh.vertices[at(kept)] = mesh.vertices[v];
        new_number[v] = kept++;
    }
    mesh.vertices.resize(at(kept));
    for (int& corner : mesh.corners) corner = new_number[at(corner)];
    parsed.warnings.push_back(path + ": " + left_out_sentence(places_.size()));
    return parsed;
}

}  // namespace coseg
