#pragma once
// What all ranks and the report know of the meshes of a collection.

#include <string>
#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

/// What every rank knows of a mesh. `mesh` counts usable meshes only, in the collection's order.
struct MeshFacts {
    std::string name;
    std::string path;
    int owner = 0;  ///< the rank that holds its description
    int input_faces = 0;
    int working_faces = 0;
    bool remeshed = false;
    double overlong_area = 0.0;  ///< see src/remesh/face_suitability.hpp
    double seconds = 0.0;
    bool reused = false;  ///< its description came from the state folder
    std::vector<std::string> warnings;
    static constexpr auto fields() {
        return std::tuple(
            field("name", &MeshFacts::name), field("path", &MeshFacts::path),
            field("rank", &MeshFacts::owner), field("faces", &MeshFacts::input_faces),
            field("working_faces", &MeshFacts::working_faces), field("remeshed", &MeshFacts::remeshed),
            field("overlong_area", &MeshFacts::overlong_area), field("seconds", &MeshFacts::seconds),
            field("reused", &MeshFacts::reused), field("warnings", &MeshFacts::warnings));
    }
};

struct SetAside {
    std::string path;
    std::string reason;
    static constexpr auto fields() {
        return std::tuple(field("path", &SetAside::path), field("reason", &SetAside::reason));
    }
};

}  // namespace coseg
