// Measures the stages before the optimiser beside their floors. A floor is the part of the same work that
// cannot be avoided, done by itself.
//
//   stage_floors_bench MESH ...          JSON on standard output; seconds are sums over the meshes
//
// stage              floor
// shape_diameter     Embree alone: as many rays of the same cone, in packets that are prepared before,
//                    without our filter
// geodesics          for every sixteen samples one Dijkstra search of the whole surface, which gives their
//                    order, and every arc of the surface graph relaxed once for each of them
// words              the shape contexts of all faces read once for every round over all of them, those of a
//                    sample once for every seed, and one product of all contexts with all words
// oversegmentation   on every level of the recursive cuts, one sparse factorisation and the solves of one
//                    Fiedler vector, of the super-faces' graph
//
// A floor is a bound for the method as it is, not for what another method could do.

#include <embree3/rtcore.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <cstring>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/mpi_program.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "solvers/kmeans/shape_words.hpp"
#include "solvers/numeric/blas.hpp"
#include "solvers/oversegmentation/face_agglomeration.hpp"
#include "solvers/oversegmentation/oversegmentation.hpp"
#include "solvers/oversegmentation/weighted_graph.hpp"
#include "src/base/stopwatch.hpp"
#include "src/descriptors/shape_context.hpp"
#include "src/descriptors/shape_diameter.hpp"
#include "src/geodesics/geodesic.hpp"
#include "src/geodesics/shortest_paths.hpp"
#include "src/geodesics/surface_graph.hpp"
#include "src/mesh/dihedral_cost.hpp"
#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/ray_scene.hpp"
#include "src/repair/mesh_repair.hpp"

namespace {

constexpr int samples = 300;
constexpr int words = 100;
constexpr int patches = 50;
constexpr int solves_of_a_vector = 20;  // the size of the Lanczos basis

double seconds_of(const std::function<void()>& work) {
    const coseg::Stopwatch clock;
    work();
    return clock.seconds();
}

struct Stage {
    double seconds = 0.0;
    double floor = 0.0;
    double work = 0.0;  ///< rays, relaxations, bytes read, cuts
};

struct Mesh {
    coseg::TriMesh surface;
    coseg::FaceGeometry geometry;
    Eigen::Matrix3Xd normals;
    coseg::DualGraph dual;
};

Mesh prepared(const std::string& path) {
    Mesh mesh;
    mesh.surface = coseg::repair(coseg::read_mesh(path), path).mesh;
    mesh.geometry = coseg::face_geometry(mesh.surface);
    mesh.normals = coseg::face_normals(mesh.surface);
    mesh.dual = coseg::dual_graph(mesh.surface, mesh.geometry);
    return mesh;
}

RTCRayHit16 packet_of(const Mesh& mesh, int face, const coseg::RayCone& cone, int first) {
    RTCRayHit16 packet{};
    const Eigen::Vector3d inward = -mesh.normals.col(face);
    const Eigen::Vector3d u = inward.unitOrthogonal();
    Eigen::Matrix3d frame;
    frame << u, inward.cross(u), inward;
    for (int i = 0; i < 16; ++i) {
        const Eigen::Vector3d direction =
            frame * cone.directions.col(std::min(first + i, coseg::shape_diameter_rays - 1));
        coseg::set_ray(packet.ray, i, mesh.geometry.centroid.col(face).cast<float>(), direction.cast<float>(),
                       1e-5F * static_cast<float>(std::sqrt(mesh.geometry.total_area)),
                       std::numeric_limits<float>::infinity());
        packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    return packet;
}

void add_shape_diameter(const Mesh& mesh, Stage& stage) {
    stage.seconds += seconds_of([&] { coseg::shape_diameter(mesh.surface, mesh.geometry, mesh.dual); });
    const coseg::RayCone cone = coseg::shape_diameter_cone();
    const coseg::RayScene scene(mesh.surface.vertices.cast<float>(), mesh.surface.faces,
                                coseg::RayScene::Filter::none);
    alignas(64) int valid[16];
    std::fill(std::begin(valid), std::end(valid), -1);
    constexpr int group = 1024;  // faces whose packets stay in the cache between preparation and use
    std::vector<RTCRayHit16> packets;
    for (int begin = 0; begin < mesh.surface.face_count(); begin += group) {
        const int end = std::min(begin + group, mesh.surface.face_count());
        packets.clear();
        for (int f = begin; f < end; ++f) {
            packets.push_back(packet_of(mesh, f, cone, 0));
            packets.push_back(packet_of(mesh, f, cone, 16));
        }
        stage.floor += seconds_of([&] {
            for (RTCRayHit16& packet : packets) {
                RTCIntersectContext context;
                rtcInitIntersectContext(&context);
                rtcIntersect16(valid, scene.get(), &context, &packet);
            }
        });
    }
    stage.work += static_cast<double>(mesh.surface.face_count()) * coseg::shape_diameter_rays;
}

/// Returns the table, which the words need.
coseg::GeodesicTable add_geodesics(const Mesh& mesh, Stage& stage) {
    coseg::GeodesicTable table;
    stage.seconds += seconds_of(
        [&] { table = coseg::geodesic_table(mesh.surface, mesh.geometry, mesh.dual, samples, 1); });
    const coseg::SurfaceGraph graph = coseg::surface_graph(mesh.surface, mesh.dual);
    std::vector<coseg::PathLanes> distance(static_cast<std::size_t>(graph.node_count()),
                                           coseg::PathLanes::Constant(1.0F));
    const int batches = (samples + coseg::path_lanes - 1) / coseg::path_lanes;
    stage.floor += seconds_of([&] {
        for (int batch = 0; batch < batches; ++batch) {
            std::vector<float> single(distance.size(), std::numeric_limits<float>::infinity());
            const std::vector<coseg::PathSource> source{{batch % graph.vertex_count, 0.0F}};
            coseg::lower_distances(graph, source, single);
            for (int v = 0; v < graph.node_count(); ++v) {
                coseg::PathLanes best = distance[static_cast<std::size_t>(v)];
                for (int k = graph.offsets[static_cast<std::size_t>(v)];
                     k < graph.offsets[static_cast<std::size_t>(v) + 1]; ++k) {
                    const coseg::SurfaceArc& arc = graph.arcs[static_cast<std::size_t>(k)];
                    best = best.min(distance[static_cast<std::size_t>(arc.node)] + arc.length);
                }
                distance[static_cast<std::size_t>(v)] = best;
            }
        }
    });
    stage.work += static_cast<double>(graph.arcs.size()) * samples;
    return table;
}

void add_words(const coseg::Comm& comm, const std::vector<Eigen::MatrixXf>& contexts, Stage& stage) {
    std::vector<coseg::ShapeWordInput> input;
    for (std::size_t k = 0; k < contexts.size(); ++k) input.push_back({k + 1, &contexts[k]});
    stage.seconds += seconds_of([&] { coseg::shape_words(comm, input, words, 1); });
    std::int64_t all_faces = 0;
    for (const Eigen::MatrixXf& context : contexts) all_faces += context.cols();
    double sum = 0.0;  // used below, so that nothing is left out as without effect
    for (const Eigen::MatrixXf& context : contexts) {
        const int faces = static_cast<int>(context.cols());
        const Eigen::MatrixXf centres = context.leftCols(std::min(words, faces));
        Eigen::MatrixXf product(centres.cols(), faces);
        std::vector<float> copy(static_cast<std::size_t>(context.size()));
        stage.floor += seconds_of([&] {
            coseg::multiply_transposed(coseg::whole(centres), coseg::whole(context), 0.0F,
                                       coseg::whole(product));
            for (int round = 0; round < coseg::word_rounds; ++round) {
                std::memcpy(copy.data(), context.data(), copy.size() * sizeof(float));
                sum += static_cast<double>(copy[static_cast<std::size_t>(round)]);
            }
            const double share =
                static_cast<double>(coseg::word_sample_faces) / static_cast<double>(all_faces);
            const auto sampled =
                static_cast<std::size_t>(std::min(share, 1.0) * static_cast<double>(copy.size()));
            for (int seed = 0; seed < words && sampled > 0; ++seed) {
                std::memcpy(copy.data(), context.data(), sampled * sizeof(float));
                sum += static_cast<double>(copy[0]);
            }
        });
        stage.work +=
            static_cast<double>(context.size()) * static_cast<double>(sizeof(float)) * coseg::word_rounds;
    }
    if (std::isnan(sum)) std::cerr << "contexts that are no numbers\n";
}

Eigen::SparseMatrix<double> laplacian_of(const coseg::WeightedGraph& graph) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int v = 0; v < graph.node_count(); ++v) {
        double degree = 1e-9;
        for (int k = graph.offsets[static_cast<std::size_t>(v)];
             k < graph.offsets[static_cast<std::size_t>(v) + 1]; ++k) {
            const double weight = graph.weights[static_cast<std::size_t>(k)];
            degree += weight;
            entries.emplace_back(v, graph.neighbors[static_cast<std::size_t>(k)], -weight);
        }
        entries.emplace_back(v, v, degree * (1.0 + 1e-6));
    }
    Eigen::SparseMatrix<double> matrix(graph.node_count(), graph.node_count());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

void add_oversegmentation(const Mesh& mesh, Stage& stage) {
    const coseg::OversegmentationOptions options{.patches = patches};
    stage.seconds += seconds_of([&] { coseg::oversegment(mesh.geometry, mesh.dual, options, 1); });
    std::vector<coseg::WeightedEdge> edges;
    for (const coseg::DualEdge& edge : mesh.dual.edges)
        edges.push_back({edge.face_a, edge.face_b, edge.length * coseg::dihedral_cost(edge)});
    const std::vector<double> mass(mesh.geometry.area.begin(), mesh.geometry.area.end());
    const coseg::WeightedGraph faces = coseg::weighted_graph(mass, edges);
    const std::vector<int> group = coseg::agglomerate(faces, options.super_faces);
    const coseg::WeightedGraph graph =
        coseg::contracted_graph(faces, group, *std::max_element(group.begin(), group.end()) + 1);
    const Eigen::SparseMatrix<double> laplacian = laplacian_of(graph);
    const int levels = static_cast<int>(std::ceil(std::log2(patches)));
    Eigen::VectorXd vector = Eigen::VectorXd::Random(graph.node_count());
    stage.floor += levels * seconds_of([&] {
                       const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(laplacian);
                       for (int k = 0; k < solves_of_a_vector; ++k)
                           vector = factor.solve(vector).normalized();
                   });
    stage.work += patches - 1;
}

nlohmann::ordered_json row(const std::string& unit, const Stage& stage) {
    return {{"seconds", stage.seconds},
            {"floor_seconds", stage.floor},
            {"ratio", stage.seconds / stage.floor},
            {unit + "_per_second", stage.work / stage.seconds},
            {unit + "_per_second_floor", stage.work / stage.floor}};
}

void measure(const coseg::Comm& comm, const std::vector<std::string>& paths) {
    Stage diameter;
    Stage geodesics;
    Stage words_stage;
    Stage patches_stage;
    std::vector<Eigen::MatrixXf> contexts;
    std::int64_t faces = 0;
    for (const std::string& path : paths) {
        const Mesh mesh = prepared(path);
        faces += mesh.surface.face_count();
        add_shape_diameter(mesh, diameter);
        contexts.push_back(
            coseg::shape_context(add_geodesics(mesh, geodesics), mesh.geometry.centroid, mesh.normals));
        add_oversegmentation(mesh, patches_stage);
    }
    add_words(comm, contexts, words_stage);
    const nlohmann::ordered_json result = {{"format", "coseg stage floors 1"},
                                           {"meshes", paths.size()},
                                           {"faces", faces},
                                           {"shape_diameter", row("rays", diameter)},
                                           {"geodesics", row("relaxations", geodesics)},
                                           {"words", row("bytes", words_stage)},
                                           {"oversegmentation", row("cuts", patches_stage)}};
    std::cout << result.dump(1) << "\n";
}

int program(int argc, char** argv) {
    coseg::use_one_blas_thread();
    CLI::App app("The stages before the optimiser beside their floors");
    std::vector<std::string> paths;
    app.add_option("meshes", paths, "Meshes")->required();
    return coseg::parse_and_run(app, argc, argv, [&] { measure(coseg::Comm(MPI_COMM_SELF), paths); });
}

}  // namespace

int main(int argc, char** argv) { return coseg::run_with_mpi(argc, argv, program); }
