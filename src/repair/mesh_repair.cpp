#include "src/repair/mesh_repair.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <sstream>
#include <utility>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/mesh/moderate_scale.hpp"
#include "src/mesh/polygon_triangulation.hpp"
#include "src/mesh/vertex_welding.hpp"
#include "src/repair/degenerate_faces.hpp"
#include "src/repair/doubled_faces.hpp"
#include "src/repair/label_donor_faces.hpp"
#include "src/repair/manifold_cut.hpp"
#include "src/repair/outlying_vertices.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

void check_input(const PolygonMesh& input, const std::string& name) {
    for (int v = 0; v < input.vertex_count(); ++v) {
        if (!input.vertices[at(v)].allFinite()) {
            throw Error(ExitCode::input,
                        name + ": vertex " + std::to_string(v) + " is not finite; correct its coordinates");
        }
    }
    for (int f = 0; f < input.face_count(); ++f) {
        for (int k = input.offsets[at(f)]; k < input.offsets[at(f) + 1]; ++k) {
            const int v = input.corners[at(k)];
            if (v >= 0 && v < input.vertex_count()) continue;
            throw Error(ExitCode::input, name + ": face " + std::to_string(f) + " refers to vertex " +
                                             std::to_string(v) + " of " +
                                             std::to_string(input.vertex_count()) + "; correct the face");
        }
    }
}

/// The face's welded corners without repetitions next to each other.
void distinct_corners(const PolygonMesh& input, const std::vector<int>& vertex_of, int face,
                      std::vector<int>& corners) {
    corners.clear();
    for (int k = input.offsets[at(face)]; k < input.offsets[at(face) + 1]; ++k) {
        const int v = vertex_of[at(input.corners[at(k)])];
        if (corners.empty() || corners.back() != v) corners.push_back(v);
    }
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
}

/// Of the faces that are not left out.
WorkingTriangles triangulate(const PolygonMesh& input, const DoubledFaces& doubles) {
    WorkingTriangles working;
    working.triangles.reserve(input.corners.size() / 3);
    working.input_face.reserve(input.corners.size() / 3);
    std::vector<int> corners;
    std::vector<Vector3d> positions;
    for (int f = 0; f < input.face_count(); ++f) {
        if (doubles.left_out[at(f)] != 0) continue;
        distinct_corners(input, doubles.vertex_of, f, corners);
        if (corners.size() == 3) {
            working.triangles.emplace_back(corners[0], corners[1], corners[2]);
            working.input_face.push_back(f);
        } else if (corners.size() > 3) {
            positions.clear();
            for (const int v : corners) positions.push_back(input.vertices[at(v)]);
            for (const Vector3i& t : triangulate_polygon(positions)) {
                working.triangles.emplace_back(corners[at(t[0])], corners[at(t[1])], corners[at(t[2])]);
                working.input_face.push_back(f);
            }
        }
    }
    return working;
}

TriMesh to_mesh(const PolygonMesh& input, const ManifoldCut& cut) {
    TriMesh mesh;
    mesh.vertices.resize(3, static_cast<Eigen::Index>(cut.source_vertex.size()));
    for (std::size_t v = 0; v < cut.source_vertex.size(); ++v) {
        mesh.vertices.col(static_cast<Eigen::Index>(v)) = input.vertices[at(cut.source_vertex[v])];
    }
    mesh.faces.resize(3, static_cast<Eigen::Index>(cut.triangles.size()));
    for (std::size_t f = 0; f < cut.triangles.size(); ++f)
        mesh.faces.col(static_cast<Eigen::Index>(f)) = cut.triangles[f];
    return mesh;
}

int count_welded(const std::vector<int>& vertex_of) {
    int welded = 0;
    for (std::size_t v = 0; v < vertex_of.size(); ++v) welded += vertex_of[v] != static_cast<int>(v) ? 1 : 0;
    return welded;
}

int count_unused(const PolygonMesh& input) {
    std::vector<char> used(input.vertices.size(), 0);
    for (const int v : input.corners) used[at(v)] = 1;
    return static_cast<int>(std::count(used.begin(), used.end(), 0));
}

std::vector<char> faces_with_triangles(const WorkingTriangles& working, int input_faces) {
    std::vector<char> has_triangle(at(input_faces), 0);
    for (const int f : working.input_face) has_triangle[at(f)] = 1;
    return has_triangle;
}

int count_lost(const std::vector<char>& has_triangle) {
    return static_cast<int>(std::count(has_triangle.begin(), has_triangle.end(), 0));
}

class Warnings {
  public:
    explicit Warnings(const std::string& name) : name_(name) {}
    void add(int count, const std::string& one, const std::string& many) {
        if (count > 0)
            sentences_.push_back(name_ + ": " + std::to_string(count) + " " + (count == 1 ? one : many));
    }
    std::vector<std::string> take() { return std::move(sentences_); }

  private:
    const std::string& name_;
    std::vector<std::string> sentences_;
};

/// What was done before the surface was cut to a manifold.
struct RepairCounts {
    int unused = 0;
    int welded = 0;
    int near = 0;
    NearBorders apart;
    int doubled = 0;
    int faces_without_area = 0;
    int outlying = 0;
};

/// Nothing where no borders nearly touch. The tolerance named is the least of one digit that joins them.
std::string sentence_of(const std::string& name, const NearBorders& apart) {
    if (apart.pieces == 0) return "";
    const double unit = std::pow(10.0, std::floor(std::log10(apart.distance)));
    std::ostringstream sentence;
    sentence << name << ": " << apart.pieces
             << (apart.pieces == 1 ? " piece has borders that nearly touch, "
                                   : " pieces have borders that nearly touch, ")
             << std::scientific << std::setprecision(1) << apart.distance
             << " of the size apart; if they are meant to be one surface, give --weld "
             << std::setprecision(0) << std::min(std::ceil(apart.distance / unit) * unit, 1e-3);
    return sentence.str();
}

std::vector<std::string> describe(const std::string& name, const RepairCounts& counts,
                                  const ManifoldCut& cut) {
    Warnings warnings(name);
    warnings.add(counts.unused, "vertex belongs to no face and is left out",
                 "vertices belong to no face and are left out");
    warnings.add(counts.welded, "repeated vertex is welded", "repeated vertices are welded");
    warnings.add(counts.near, "vertex on borders that nearly touch is welded",
                 "vertices on borders that nearly touch are welded");
    warnings.add(counts.doubled, "face lies upon another and shares its part",
                 "faces lie upon others and share their parts");
    warnings.add(counts.faces_without_area, "face without area takes the part of a neighbour",
                 "faces without area take the part of a neighbour");
    warnings.add(counts.outlying,
                 "vertex lies far away from the shape; its faces take the part of a neighbour",
                 "vertices lie far away from the shape; their faces take the part of a neighbour");
    warnings.add(cut.crowded_edges, "edge has three or more faces and is cut",
                 "edges have three or more faces and are cut");
    warnings.add(cut.unorientable_edges, "edge joins faces that cannot be oriented alike and is cut",
                 "edges join faces that cannot be oriented alike and are cut");
    warnings.add(cut.copied_vertices, "copy of a vertex separates surfaces that meet there",
                 "copies of vertices separate surfaces that meet there");
    warnings.add(cut.flipped_triangles, "triangle is turned to face outward",
                 "triangles are turned to face outward");
    std::vector<std::string> sentences = warnings.take();
    const std::string apart = sentence_of(name, counts.apart);
    if (!apart.empty()) sentences.push_back(apart);
    return sentences;
}

/// Whose label each input face takes. working: triangles whose input faces share the label of no other face.
std::vector<int> label_donors(const PolygonMesh& input, const WorkingTriangles& working,
                              const DoubledFaces& doubles) {
    const std::vector<char> has_triangle = faces_with_triangles(working, input.face_count());
    std::vector<char> has_label = has_triangle;
    for (int f = 0; f < input.face_count(); ++f) {
        if (has_triangle[at(doubles.label_of[at(f)])] != 0) has_label[at(f)] = 1;
    }
    std::vector<int> donors = label_donor_faces(input, doubles.vertex_of, has_label);
    for (int& donor : donors) donor = doubles.label_of[at(donor)];
    return donors;
}

/// The triangles of the input that the working mesh is cut from, and what was left out before.
WorkingTriangles working_triangles(const PolygonMesh& input, const std::string& name,
                                   const DoubledFaces& doubles, RepairCounts& counts) {
    WorkingTriangles working = triangulate(input, doubles);
    const auto lost = [&] { return count_lost(faces_with_triangles(working, input.face_count())); };
    const int without_triangle = lost();
    counts.outlying = remove_outlying(working, input.vertices);
    const int lost_to_spikes = lost() - without_triangle;
    remove_degenerate(working, input.vertices);
    if (working.triangles.empty()) {
        throw Error(ExitCode::input, name + ": no face has an area; check the coordinates and the faces");
    }
    const auto left_out =
        static_cast<int>(std::count(doubles.left_out.begin(), doubles.left_out.end(), char{1}));
    counts.faces_without_area = lost() - lost_to_spikes - left_out;
    for (int& face : working.input_face) face = doubles.label_of[at(face)];
    return working;
}

RepairedMesh repair_moderate(const PolygonMesh& input, const std::string& name, const BorderLimits& welding) {
    const std::vector<int> equal = weld_vertices(input);
    BorderWelding welded = weld_near_borders(input, equal, welding);
    RepairCounts counts{.unused = count_unused(input),
                        .welded = count_welded(equal),
                        .near = welded.welded,
                        .apart = near_borders(input, welded.vertex_of)};
    const DoubledFaces doubles = find_doubled_faces(input, std::move(welded.vertex_of));
    counts.doubled = doubles.count;
    WorkingTriangles working = working_triangles(input, name, doubles, counts);

    RepairedMesh result;
    result.map.input_faces = input.face_count();
    result.map.label_donor = label_donors(input, working, doubles);
    const ManifoldCut cut = cut_to_manifold(working.triangles, input.vertices);
    result.mesh = to_mesh(input, cut);
    result.map.input_face = std::move(working.input_face);
    result.warnings = describe(name, counts, cut);
    return result;
}

}  // namespace

RepairedMesh repair(const PolygonMesh& input, const std::string& name, const BorderLimits& welding) {
    check_input(input, name);
    const int exponent = extreme_exponent(input);
    if (exponent == 0) return repair_moderate(input, name, welding);
    return repair_moderate(scaled_by_power(input, -exponent), name, welding);
}

}  // namespace coseg
