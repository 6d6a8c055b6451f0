#include "mpi_drivers/describe/description_file.hpp"

#include <gtest/gtest.h>

#include <array>

#include "io/files/atomic_file.hpp"
#include "io/mesh_files/off_format.hpp"
#include "mpi_drivers/describe/kept_description.hpp"
#include "mpi_drivers/optimise/solver_checkpoint_files.hpp"
#include "src/families/shape_families.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::content_of;
using test::error_of;
using test::TemporaryFolder;

const DescriptionOptions quick{.seed = 3,
                               .remesh = RemeshMode::automatic,
                               .patches = 8,
                               .oversegmentations = 2,
                               .cut_noise = 0.3,
                               .geodesic_samples = 20,
                               .descriptors = {0, 1, 2, 3, 4}};

MeshEntry small_mesh(const TemporaryFolder& folder) {
    write_off(folder.path("stool.off"), generate_shape("table", 1, 0, 2000).mesh);
    return {"stool", folder.path("stool.off"), 1};
}

template <class T>
void expect_equal(const std::vector<T>& a, const std::vector<T>& b, bool (*same)(const T&, const T&)) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) ASSERT_TRUE(same(a[k], b[k])) << k;
}

void expect_same(const FaceDescriptors& a, const FaceDescriptors& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_EQ(a[k].row, b[k].row);
        EXPECT_EQ(a[k].values, b[k].values) << k;
    }
}

void expect_same(const DescribedMesh& made, const DescribedMesh& read) {
    const MeshDescription& a = made.mesh;
    const MeshDescription& b = read.mesh;
    EXPECT_EQ(made.descriptors.size(), quick.descriptors.size());
    expect_same(made.descriptors, read.descriptors);
    EXPECT_EQ(a.mesh, b.mesh);
    EXPECT_EQ(a.key, b.key);
    EXPECT_EQ(a.input.corners, b.input.corners);
    EXPECT_EQ(a.remeshed, b.remeshed);
    EXPECT_EQ(a.overlong_area, b.overlong_area);
    EXPECT_EQ(a.map.input_faces, b.map.input_faces);
    EXPECT_EQ(a.map.input_face, b.map.input_face);
    EXPECT_EQ(a.map.label_donor, b.map.label_donor);
    EXPECT_EQ(a.map.nearest_working, b.map.nearest_working);
    EXPECT_EQ(a.geometry.area, b.geometry.area);
    EXPECT_EQ(a.geometry.centroid, b.geometry.centroid);
    EXPECT_EQ(a.geometry.total_area, b.geometry.total_area);
    EXPECT_EQ(a.graph.face_count, b.graph.face_count);
    expect_equal<DualEdge>(a.graph.edges, b.graph.edges, [](const DualEdge& x, const DualEdge& y) {
        return std::array{x.face_a, x.face_b, x.vertex_a, x.vertex_b} ==
                   std::array{y.face_a, y.face_b, y.vertex_a, y.vertex_b} &&
               x.length == y.length && x.dihedral == y.dihedral;
    });
    EXPECT_EQ(a.patches, b.patches);
    EXPECT_EQ(a.patch_counts, b.patch_counts);
    ASSERT_EQ(a.neighbors.size(), b.neighbors.size());
    for (std::size_t s = 0; s < a.neighbors.size(); ++s) {
        expect_equal<PatchNeighbors>(
            a.neighbors[s], b.neighbors[s], [](const PatchNeighbors& x, const PatchNeighbors& y) {
                return x.patch_a == y.patch_a && x.patch_b == y.patch_b &&
                       x.boundary_length == y.boundary_length && x.concavity == y.concavity;
            });
    }
    ASSERT_EQ(a.overlaps.size(), b.overlaps.size());
    for (std::size_t k = 0; k < a.overlaps.size(); ++k) {
        EXPECT_EQ(a.overlaps[k].oversegmentation_a, b.overlaps[k].oversegmentation_a);
        EXPECT_EQ(a.overlaps[k].oversegmentation_b, b.overlaps[k].oversegmentation_b);
        expect_equal<PatchOverlap>(a.overlaps[k].overlaps, b.overlaps[k].overlaps,
                                   [](const PatchOverlap& x, const PatchOverlap& y) {
                                       return x.patch_a == y.patch_a && x.patch_b == y.patch_b &&
                                              x.intersection_over_union == y.intersection_over_union;
                                   });
    }
    EXPECT_EQ(a.warnings, b.warnings);
}

TEST(KeptDescription, IsTheSameToTheBitWhenReused) {
    const TemporaryFolder place;
    const MeshEntry entry = small_mesh(place);
    const StateFolder folder = StateFolder::make(place.path("state"));
    const DescribedMesh made = kept_description(4, entry, quick, nullptr);
    const DescribedMesh first = kept_description(4, entry, quick, &folder);
    const DescribedMesh second = kept_description(4, entry, quick, &folder);
    EXPECT_FALSE(first.mesh.reused);
    EXPECT_TRUE(second.mesh.reused);
    expect_same(made, first);
    expect_same(made, second);
    EXPECT_EQ(folder.files().size(), 1U);
}

TEST(KeptDescription, OfARemeshedMeshSaysWhichWorkingFaceIsNearest) {
    const TemporaryFolder place;
    const MeshEntry entry = small_mesh(place);
    const StateFolder folder = StateFolder::make(place.path("state"));
    DescriptionOptions remeshed = quick;
    remeshed.remesh = RemeshMode::always;
    const DescribedMesh made = kept_description(4, entry, remeshed, &folder);
    const DescribedMesh again = kept_description(4, entry, remeshed, &folder);
    EXPECT_TRUE(again.mesh.reused);
    EXPECT_FALSE(made.mesh.map.nearest_working.empty());
    expect_same(made, again);
}

TEST(KeptDescription, IsMadeAnewIfItsFileIsDamaged) {
    const TemporaryFolder place;
    const MeshEntry entry = small_mesh(place);
    const StateFolder folder = StateFolder::make(place.path("state"));
    const DescribedMesh made = kept_description(0, entry, quick, &folder);
    const std::string file = folder.files().front().path;
    std::string bytes = content_of(file);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    write_file(file, bytes);
    DescribedMesh again = kept_description(0, entry, quick, &folder);
    EXPECT_FALSE(again.mesh.reused);
    ASSERT_EQ(again.mesh.warnings.size(), made.mesh.warnings.size() + 1);
    EXPECT_NE(again.mesh.warnings.back().find(file + ": is damaged"), std::string::npos)
        << again.mesh.warnings.back();
    again.mesh.warnings.pop_back();
    expect_same(made, again);
    EXPECT_EQ(folder.leftovers().size(), 1U);
    EXPECT_TRUE(kept_description(0, entry, quick, &folder).mesh.reused);
}

TEST(KeptDescription, NamesAMeshThatHasMoved) {
    const TemporaryFolder place;
    const StateFolder folder = StateFolder::make(place.path("state"));
    // Coarse: refined with a warning that names the path.
    const std::string tetrahedron =
        "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
    const MeshEntry here{"t", place.file("t.off", tetrahedron), 1};
    const DescribedMesh first = kept_description(0, here, quick, &folder);
    std::filesystem::create_directory(place.path("there"));
    const MeshEntry there{"t", place.file("there/t.off", tetrahedron), 1};
    const DescribedMesh second = kept_description(0, there, quick, &folder);
    EXPECT_TRUE(second.mesh.reused);
    ASSERT_EQ(first.mesh.warnings.size(), 1U);
    EXPECT_TRUE(first.mesh.warnings.front().starts_with(here.path));
    EXPECT_TRUE(second.mesh.warnings.front().starts_with(there.path));
}

TEST(DescriptionKey, ChangesWithAllThatMatters) {
    const std::string bytes = "OFF";
    const ContentHash key = description_key(bytes, "a", "x/a.off", quick);
    EXPECT_EQ(description_key(bytes, "a", "y/a.off", quick), key);
    EXPECT_NE(description_key("OFF ", "a", "x/a.off", quick), key);
    EXPECT_NE(description_key(bytes, "b", "x/a.off", quick), key);
    EXPECT_NE(description_key(bytes, "a", "x/a.ply", quick), key);
    for (int change = 0; change < 7; ++change) {
        DescriptionOptions other = quick;
        if (change == 0) other.seed = 4;
        if (change == 1) other.patches = 9;
        if (change == 2) other.oversegmentations = 3;
        if (change == 3) other.cut_noise = 0.31;
        if (change == 4) other.geodesic_samples = 21;
        if (change == 5) other.remesh = RemeshMode::never;
        if (change == 6) other.descriptors = {0, 1, 2, 3};
        EXPECT_NE(description_key(bytes, "a", "x/a.off", other), key) << change;
    }
}

TEST(TileFile, ReturnsWhatWasWritten) {
    const TemporaryFolder folder;
    std::vector<SolvedTile> tiles(2);
    tiles[0].begin = 32;
    tiles[0].end = tiles[1].begin = 34;
    tiles[1].end = 35;
    tiles[0].offsets = {0, 2, 2};
    tiles[0].rows = {7, 9};
    tiles[0].values = {0.1, 0.2, 0.3, 0.4};
    tiles[0].decrease = {1.5, 0.0};
    tiles[0].largest_decrease = {1.75, 0.25};
    tiles[0].iterations = 11;
    tiles[0].limited = true;
    tiles[0].rounds = {{0.0, 2.5, 0, 0}, {1.5, 2.0, 11, 6000000000}};
    tiles[1].offsets = {0, 1};
    tiles[1].rows = {3};
    tiles[1].values = {1.0 / 3.0, 0.0};
    tiles[1].decrease = {2.0};
    tiles[1].largest_decrease = {2.5};
    tiles[1].passes = 4;
    tiles[1].working_pairs = 5;
    tiles[1].residual = 1e-9;
    tiles[1].rounds = {{2.0, 2.5, 3, 1}};
    write_tiles(folder.path("tiles.h5"), tiles, 2);
    const std::vector<SolvedTile> read = read_tiles(folder.path("tiles.h5"));
    ASSERT_EQ(read.size(), 2U);
    for (std::size_t t = 0; t < 2; ++t) {
        EXPECT_EQ(read[t].begin, tiles[t].begin);
        EXPECT_EQ(read[t].end, tiles[t].end);
        EXPECT_EQ(read[t].offsets, tiles[t].offsets);
        EXPECT_EQ(read[t].rows, tiles[t].rows);
        EXPECT_EQ(read[t].values, tiles[t].values);
        EXPECT_EQ(read[t].decrease, tiles[t].decrease);
        EXPECT_EQ(read[t].largest_decrease, tiles[t].largest_decrease);
        EXPECT_EQ(read[t].residual, tiles[t].residual);
        EXPECT_EQ(read[t].iterations, tiles[t].iterations);
        EXPECT_EQ(read[t].passes, tiles[t].passes);
        EXPECT_EQ(read[t].working_pairs, tiles[t].working_pairs);
        EXPECT_EQ(read[t].limited, tiles[t].limited);
        EXPECT_EQ(read[t].rounds, tiles[t].rounds);
    }
}

}  // namespace
}  // namespace coseg
