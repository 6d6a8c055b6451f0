#pragma once
// The closed triangle meshes of the data folder, for tests that want real shapes.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "src/mesh/tri_mesh.hpp"

namespace coseg::test {

/// The folder with the labelled sets: COSEG_DATA, else `shared/data` beside the folder COSEG_SOURCE. Empty if
/// absent.
inline std::filesystem::path data_folder() {
    namespace fs = std::filesystem;
    if (const char* data = std::getenv("COSEG_DATA"); data != nullptr && fs::is_directory(data)) return data;
    if (const char* source = std::getenv("COSEG_SOURCE"); source != nullptr) {
        const fs::path beside = fs::path(source) / ".." / "shared" / "data";
        if (fs::is_directory(beside)) return beside;
    }
    return {};
}

/// A triangle mesh in OFF format as it stands in the file.
inline TriMesh read_off(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::string magic;
    int vertices = 0, faces = 0, edges = 0;
    in >> magic >> vertices >> faces >> edges;
    if (!in || magic != "OFF") throw std::runtime_error("not an OFF file: " + path.string());
    TriMesh mesh;
    mesh.vertices.resize(3, vertices);
    mesh.faces.resize(3, faces);
    for (int v = 0; v < vertices; ++v)
        in >> mesh.vertices(0, v) >> mesh.vertices(1, v) >> mesh.vertices(2, v);
    for (int f = 0; f < faces; ++f) {
        int corners = 0;
        in >> corners >> mesh.faces(0, f) >> mesh.faces(1, f) >> mesh.faces(2, f);
        if (corners != 3) throw std::runtime_error("not a triangle: face " + std::to_string(f));
    }
    if (!in) throw std::runtime_error("ends early: " + path.string());
    return mesh;
}

/// One label per face line.
inline std::vector<int> read_seg(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::vector<int> labels;
    for (int label = 0; in >> label;) labels.push_back(label);
    return labels;
}

/// The meshes of one set, sorted by path.
inline std::vector<std::filesystem::path> off_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".off") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

struct NamedMesh {
    std::string name;
    TriMesh mesh;
};

/// Every ninth mesh of three sets that differ much; none without the data folder.
inline std::vector<NamedMesh> various_meshes() {
    std::vector<NamedMesh> meshes;
    if (data_folder().empty()) return meshes;
    for (const char* set : {"psb_airplane", "coseg_chairs", "humans_adobe"}) {
        const auto files = off_files(data_folder() / set);
        for (std::size_t i = 0; i < files.size(); i += 9)
            meshes.push_back({files[i].string(), read_off(files[i])});
    }
    return meshes;
}

}  // namespace coseg::test
