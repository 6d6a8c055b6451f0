#include "src/families/shape_families.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/spelling.hpp"
#include "src/families/family_recipes.hpp"
#include "src/families/isosurface.hpp"
#include "src/families/label_cleaning.hpp"
#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/remesh/isotropic_remesh.hpp"

namespace coseg {

namespace {

struct Recipe {
    ShapeFamily family;
    ImplicitShape (*make)(SeededStream& random, int index);
};

const std::vector<Recipe>& recipes() {
    static const std::vector<Recipe> all{
        {{"cup", "open vessels of many profiles, with one handle, two or none", {"body", "handle"}},
         make_cup},
        {{"goblet", "a bowl on a plain or knobbed stem", {"bowl", "stem", "base"}}, make_goblet},
        {{"table", "round and rectangular tops on three to six legs, some with stretchers", {"top", "leg"}},
         make_table},
        {{"chair", "chairs with panels or rails, swivel chairs, stools", {"seat", "leg", "back"}},
         make_chair},
        {{"lamp", "standing lamps, goose necks and jointed arms", {"base", "pole", "shade"}}, make_lamp},
        {{"airplane",
          "straight and swept wings, T-tails, no engines to four",
          {"fuselage", "wing", "stabilizer", "engine", "fin"}},
         make_airplane},
        {{"pliers", "broad and slender jaws, opened by various angles", {"jaw", "joint", "handle"}},
         make_pliers},
        {{"quadruped",
          "four-legged animals in step, long and short in leg, neck and trunk",
          {"body", "head", "leg", "tail"}},
         make_quadruped},
        {{"human", "figures with moving arms and legs", {"head", "torso", "arm", "leg"}}, make_human},
        {{"ant", "six legs, two antennae", {"head", "thorax", "abdomen", "leg", "antenna"}}, make_ant},
        {{"octopus", "five to eight curling tentacles", {"head", "tentacle"}}, make_octopus},
    };
    return all;
}

TriMesh extract(const ImplicitShape& shape) {
    // Fine enough for the thinnest part to hold a lattice point everywhere, and for the wedges beside the
    // creases not to be bridged; the steepest primitives may overshoot.
    constexpr double points_through_thinnest = 1.8;
    constexpr double points_across_crease = 1.0;
    constexpr double steepest = 2.0;
    const double size = shape.bounds().diagonal().norm();
    const double spacing = std::min({size / 60.0, shape.thickness() / points_through_thinnest,
                                     shape.smallest_blend() / points_across_crease});
    TriMesh mesh = isosurface([&](const Eigen::Vector3d& p) { return shape.distance(p); }, shape.bounds(),
                              spacing, steepest);
    for (int v = 0; v < mesh.vertex_count(); ++v) mesh.vertices.col(v) = shape.project(mesh.vertices.col(v));
    return mesh;
}

/// Even triangles, their number within a few per cent of the target: the edge length is corrected between the
/// rounds.
TriMesh even_triangles(const ImplicitShape& shape, TriMesh mesh, int target_faces) {
    constexpr int stages = 3;
    constexpr int most_stages = 8;
    constexpr double tolerance = 0.1;
    const SurfaceProjection project = [&](const Eigen::Vector3d& p, const Eigen::Vector3d&) {
        return shape.project(p);
    };
    RemeshOptions options;
    options.smallest_share = 0.55;
    options.iterations = 2;
    // Thin limbs get shorter edges, so the others are longer than on a plain surface of that area.
    options.edge_length = 1.06 * edge_length_for(face_geometry(mesh).total_area, target_faces);
    for (int stage = 1; stage <= most_stages; ++stage) {
        mesh = isotropic_remesh(mesh, options, project);
        const double ratio = static_cast<double>(mesh.face_count()) / target_faces;
        if (stage >= stages && std::abs(ratio - 1.0) < tolerance) break;
        options.edge_length *= std::pow(ratio, 0.6);
    }
    return mesh;
}

std::vector<int> part_labels(const ImplicitShape& shape, const TriMesh& mesh, const DualGraph& graph,
                             const FaceGeometry& geometry) {
    std::vector<int> labels(at(mesh.face_count()));
    for (int f = 0; f < mesh.face_count(); ++f) labels[f] = shape.nearest_label(geometry.centroid.col(f));
    merge_label_islands(graph, std::max(6, mesh.face_count() / 500), labels);
    remove_label_teeth(graph, labels);
    return labels;
}

}  // namespace

const std::vector<ShapeFamily>& shape_families() {
    static const std::vector<ShapeFamily> families = [] {
        std::vector<ShapeFamily> list;
        for (const Recipe& recipe : recipes()) list.push_back(recipe.family);
        return list;
    }();
    return families;
}

const ShapeFamily& nearest_family(const std::string& name) {
    return *std::min_element(shape_families().begin(), shape_families().end(),
                             [&](const ShapeFamily& a, const ShapeFamily& b) {
                                 return edit_distance(a.name, name) < edit_distance(b.name, name);
                             });
}

const ShapeFamily& shape_family(const std::string& name) {
    std::string names;
    for (const ShapeFamily& family : shape_families()) {
        if (family.name == name) return family;
        names += (names.empty() ? "" : ", ") + family.name;
    }
    throw Error(ExitCode::usage, "there is no family '" + name + "'; did you mean '" +
                                     nearest_family(name).name + "'? The families are " + names);
}

LabeledShape generate_shape(const std::string& family, std::uint64_t seed, int index, int target_faces) {
    const std::ptrdiff_t number = &shape_family(family) - shape_families().data();
    const Recipe& recipe = recipes()[at(number)];
    if (target_faces < least_generated_faces || target_faces > most_generated_faces) {
        throw Error(ExitCode::usage, "a generated shape has " + std::to_string(least_generated_faces) +
                                         " to " + std::to_string(most_generated_faces) + " faces, not " +
                                         std::to_string(target_faces));
    }
    SeededStream random(hash_words({seed, hash_text(family), static_cast<std::uint64_t>(index)}));
    const ImplicitShape solid = recipe.make(random, index);
    LabeledShape shape;
    shape.mesh = even_triangles(solid, extract(solid), target_faces);
    const FaceGeometry geometry = face_geometry(shape.mesh);
    const DualGraph graph = dual_graph(shape.mesh, geometry);
    const std::vector<int> components = face_components(graph);
    if (*std::max_element(components.begin(), components.end()) > 0) {
        throw Error(ExitCode::internal,
                    family + " " + std::to_string(index) + " of seed " + std::to_string(seed) +
                        " came out in several pieces; take another seed and report this one");
    }
    shape.face_label = part_labels(solid, shape.mesh, graph, geometry);
    shape.label_names = recipe.family.labels;
    return shape;
}

}  // namespace coseg
