#include "src/families/shape_families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <tuple>

#include "src/base/error.hpp"
#include "src/families/label_cleaning.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/surface_checks.hpp"

namespace coseg {
namespace {

constexpr int target_faces = 2500;

class EveryFamily : public testing::TestWithParam<std::string> {};

/// A shape of 2,500 faces or so. It is made once for all tests, as making it takes much longer than looking.
const LabeledShape& made_once(const std::string& family, std::uint64_t seed, int index) {
    static std::map<std::tuple<std::string, std::uint64_t, int>, LabeledShape> made;
    const auto key = std::make_tuple(family, seed, index);
    const auto found = made.find(key);
    if (found != made.end()) return found->second;
    return made.emplace(key, generate_shape(family, seed, index, target_faces)).first->second;
}

/// Whether shapes of the family may have handles, stretchers or rails, and so tunnels.
bool has_rings(const std::string& family) {
    return family == "cup" || family == "table" || family == "chair";
}

/// Pieces of one label: connected faces.
int piece_count(const LabeledShape& shape, int label) {
    const DualGraph graph = dual_graph(shape.mesh, face_geometry(shape.mesh));
    std::vector<char> seen(shape.face_label.size(), 0);
    int pieces = 0;
    for (int seed = 0; seed < graph.face_count; ++seed) {
        if (seen[seed] != 0 || shape.face_label[seed] != label) continue;
        ++pieces;
        std::vector<int> open{seed};
        seen[seed] = 1;
        while (!open.empty()) {
            const int face = open.back();
            open.pop_back();
            for (int i = graph.offsets[face]; i < graph.offsets[face + 1]; ++i) {
                const int other = graph.other_face(graph.incident[i], face);
                if (seen[other] != 0 || shape.face_label[other] != label) continue;
                seen[other] = 1;
                open.push_back(other);
            }
        }
    }
    return pieces;
}

TEST_P(EveryFamily, ShapesAreClosedConnectedEvenAndLabelled) {
    std::set<int> labels;
    for (int index = 0; index < 4; ++index) {
        SCOPED_TRACE(GetParam() + " " + std::to_string(index));
        const LabeledShape& shape = made_once(GetParam(), 7, index);
        ASSERT_TRUE(test::is_closed_and_oriented(shape.mesh));
        EXPECT_TRUE(test::has_single_fans(shape.mesh));
        EXPECT_EQ(test::component_count(shape.mesh), 1);
        EXPECT_GT(test::volume(shape.mesh), 0.0);
        EXPECT_TRUE(shape.mesh.vertices.allFinite());
        EXPECT_TRUE(has_rings(GetParam()) || test::euler_characteristic(shape.mesh) == 2);
        EXPECT_NEAR(shape.mesh.face_count(), target_faces, 0.15 * target_faces);
        const std::vector<double> angles = test::smallest_angles(shape.mesh);
        EXPECT_GT(angles[angles.size() / 20], 25.0);
        ASSERT_EQ(static_cast<int>(shape.face_label.size()), shape.mesh.face_count());
        labels.insert(shape.face_label.begin(), shape.face_label.end());
    }
    const auto named = static_cast<int>(shape_family(GetParam()).labels.size());
    EXPECT_EQ(static_cast<int>(labels.size()), named);
    EXPECT_EQ(*labels.begin(), 0);
    EXPECT_EQ(*labels.rbegin(), named - 1);
}

TEST_P(EveryFamily, SameSeedSameBytesOtherIndexOrSeedOtherShape) {
    const LabeledShape& one = made_once(GetParam(), 7, 0);
    const LabeledShape again = generate_shape(GetParam(), 7, 0, target_faces);
    EXPECT_TRUE(one.mesh.vertices == again.mesh.vertices);
    EXPECT_TRUE(one.mesh.faces == again.mesh.faces);
    EXPECT_EQ(one.face_label, again.face_label);
    for (const LabeledShape* other : {&made_once(GetParam(), 7, 1), &made_once(GetParam(), 11, 0)}) {
        TriMesh a = one.mesh, b = other->mesh;
        scale_to_unit_area(a);
        scale_to_unit_area(b);
        const Eigen::Vector3d size_a = a.vertices.rowwise().maxCoeff() - a.vertices.rowwise().minCoeff();
        const Eigen::Vector3d size_b = b.vertices.rowwise().maxCoeff() - b.vertices.rowwise().minCoeff();
        EXPECT_GT((size_a - size_b).norm(), 1e-3);
    }
}

TEST_P(EveryFamily, BoundariesBetweenPartsAreMostlyConcave) {
    // Angles between neighbouring faces of an even mesh say whether a part boundary lies in a crease.
    const LabeledShape& shape = made_once(GetParam(), 11, 0);
    double concave = 0.0, boundary = 0.0;
    for (const DualEdge& edge : dual_graph(shape.mesh, face_geometry(shape.mesh)).edges) {
        if (shape.face_label[edge.face_a] == shape.face_label[edge.face_b]) continue;
        boundary += edge.length;
        if (edge.dihedral < std::numbers::pi - 0.05) concave += edge.length;
    }
    EXPECT_GT(boundary, 0.0);
    EXPECT_GT(concave, 0.55 * boundary);
}

std::vector<std::string> family_names() {
    std::vector<std::string> names;
    for (const ShapeFamily& family : shape_families()) names.push_back(family.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Families, EveryFamily, testing::ValuesIn(family_names()),
                         [](const auto& family) { return family.param; });

TEST(ShapeFamilies, EveryHandleOfACupIsATunnel) {
    std::set<int> seen;
    for (const int index : {0, 3, 6}) {
        const LabeledShape& cup = made_once("cup", 7, index);
        const int handles = piece_count(cup, 1);
        EXPECT_EQ(test::euler_characteristic(cup.mesh), 2 - 2 * handles) << index;
        seen.insert(handles);
    }
    EXPECT_EQ(seen, (std::set<int>{0, 1, 2}));
}

TEST(ShapeFamilies, PartsAreCountedAsTheRecipeSays) {
    EXPECT_EQ(piece_count(generate_shape("octopus", 5, 3, 3000), 1), 8);
    EXPECT_EQ(piece_count(generate_shape("octopus", 5, 0, 3000), 1), 5);
    const LabeledShape& ant = made_once("ant", 7, 0);
    for (const int single : {0, 1, 2}) EXPECT_EQ(piece_count(ant, single), 1);
    EXPECT_EQ(piece_count(ant, 3), 6);
    EXPECT_EQ(piece_count(ant, 4), 2);
    EXPECT_EQ(piece_count(made_once("airplane", 7, 0), 3), 2);
    EXPECT_EQ(piece_count(made_once("airplane", 7, 1), 3), 0);
    EXPECT_EQ(piece_count(made_once("airplane", 7, 2), 3), 4);
    EXPECT_EQ(piece_count(made_once("airplane", 7, 0), 4), 1);  // the fin
}

TEST(ShapeFamilies, UnknownNamesAreAnsweredWithTheNearest) {
    EXPECT_EQ(nearest_family("airplan").name, "airplane");
    EXPECT_EQ(nearest_family("Cups").name, "cup");
    try {
        generate_shape("tabel", 1, 0, 3000);
        FAIL() << "no throw";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_NE(std::string(error.what()).find("'table'"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("octopus"), std::string::npos);
    }
    EXPECT_THROW(generate_shape("cup", 1, 0, 10), Error);
}

TEST(LabelCleaning, IslandsGoAndLargePiecesStay) {
    const TriMesh mesh = test::sphere(3);
    const FaceGeometry geometry = face_geometry(mesh);
    const DualGraph graph = dual_graph(mesh, geometry);
    std::vector<int> halves(static_cast<std::size_t>(mesh.face_count()));
    for (int f = 0; f < mesh.face_count(); ++f) halves[f] = geometry.centroid(2, f) > 0.0 ? 1 : 0;
    std::vector<int> spotted = halves;
    int top = 0;
    geometry.centroid.row(2).maxCoeff(&top);
    spotted[top] = 2;
    spotted[graph.other_face(graph.incident[graph.offsets[top]], top)] = 2;
    merge_label_islands(graph, 6, spotted);
    EXPECT_EQ(spotted, halves);
}

TEST(LabelCleaning, TeethGoUntilThereAreNone) {
    const TriMesh mesh = test::sphere(3);
    const DualGraph graph = dual_graph(mesh, face_geometry(mesh));
    std::vector<int> labels(static_cast<std::size_t>(mesh.face_count()));
    for (int f = 0; f < mesh.face_count(); ++f) labels[f] = f % 7 == 0 ? 1 : 0;
    remove_label_teeth(graph, labels);
    for (int f = 0; f < mesh.face_count(); ++f) {
        int foreign = 0;
        for (int i = graph.offsets[f]; i < graph.offsets[f + 1]; ++i) {
            foreign += labels[graph.other_face(graph.incident[i], f)] != labels[f] ? 1 : 0;
        }
        EXPECT_LT(foreign, 2);
    }
}

}  // namespace
}  // namespace coseg
