#pragma once
// The interface of coseg for other programs: everything that is declared here, and nothing else of the
// sources, is kept from one version to the next.
//
// Meshes, shapes, failures and scores are in <coseg/shapes.hpp>, which this header includes.
//
//     std::vector<coseg::Shape> shapes = {coseg::shape_of("a.off"), coseg::shape_of(mesh_in_memory)};
//     const coseg::Segmentation result = coseg::segment(shapes, {.parts = 4});
//     result.shapes[1].labels  // the part of every face of mesh_in_memory, 0 .. 3
//
// Rules for all functions
// - Every failure is an exception of type Failure, with one sentence for the user and the exit code that the
//   program would end with. Nothing is printed and no process is ended. Signals are left alone, except by
//   segment() and assign() with a folder for their state.
// - Shapes are used while a function runs and not after it. Their memory belongs to the caller.
// - Results are in the order of the shapes that were given. The same shapes, names, options and seed give the
//   same bytes: in every call, on any number of ranks, and as `coseg run` gives them for files so named.
// - MPI is initialised by the first call that needs it, unless the program has done so, and is then finalised
//   when the program ends. Functions that take a Call are collective over its communicator: every rank calls
//   them with the same arguments, and every rank has the whole result. Without a communicator the calling
//   process works alone, also where it is one of many.
// - At most one call is at work in a process at a time; a second one throws.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <coseg/shapes.hpp>

namespace coseg {
inline namespace interface_1 {

// ---- Calls ----

struct Progress {
    std::string stage;       ///< "describe", "features", "optimise", "cut", "label" ...
    std::int64_t done = 0;   ///< of total; a stage begins with 0 of 0 and ends with 1 of 1
    std::int64_t total = 0;  ///< meshes, or columns of the optimiser
};

/// How a function runs. Nothing that it computes depends on it.
struct Call {
    /// The address of an MPI_Comm of one group, which is not MPI_COMM_NULL; null: this process alone.
    const void* communicator = nullptr;
    /// Called on every rank, in the thread of the caller. What it throws ends the call and is thrown by it:
    /// at once where one process works, at the end of the call where several do.
    std::function<void(const Progress&)> progress;
};

/// An option of `coseg run` by its name without dashes, and its value as on the command line, such as
/// {"patches", "30"}; "true" or "false" for a switch. `coseg run --help-all` lists them.
using Option = std::pair<std::string, std::string>;

/// Initialises MPI, unless that is done, as the first call would. Failure: 2 where MPI has been finalised.
COSEG_VISIBLE void start();

/// The names of the options that the functions below take.
COSEG_VISIBLE std::vector<std::string> option_names();

/// What each of these options takes, in the same order: "on or off", "whole number", "number", "numbers"
/// (joined by commas) or "text", which may be a number too.
COSEG_VISIBLE std::vector<std::string> option_kinds();

// ---- Segmentation ----

/// The labels of one shape.
struct ShapeLabels {
    std::string name;
    std::vector<int> labels;         ///< F: the part of each face, 0 .. parts - 1; empty if set aside
    std::vector<int> patches;        ///< F: the patch of each face in the first over-segmentation, from 0
    std::vector<double> part_areas;  ///< parts: shares of the shape's area, summing to 1
    std::vector<std::string> warnings;
    std::string set_aside;  ///< why the shape could not be used; empty if it was
};

/// How far the coefficients of the subspace problem are from the optimum. docs/method.md gives the problem.
struct Certificate {
    double objective = 0.0;
    double lower_bound = 0.0;  ///< proven; no coefficients have a smaller objective
    /// (objective - lower bound) / objective in row scope, where the divisor is at least 1e-6 of the
    /// objective of W = 0; in mesh scope the divisor is the decrease of the objective from W = 0.
    double relative_gap = 0.0;
    bool reached = false;  ///< whether the gap that was asked for was reached
    std::string reason;    ///< gap_reached, residual_reached, iteration_limit or time_limit
    std::int64_t iterations = 0;
    std::int64_t nonzero_pairs = 0;  ///< pairs of patches with a coefficient
};

/// How one shape is brought to stand like the others: scale * rotation * x + translation takes a point x of
/// its coordinates to the common frame, in which the centre of a shape lies near the origin and the root mean
/// square of a coordinate is about 1.
struct ShapeTransform {
    std::array<double, 9> rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row by row, orthogonal
    double scale = 1.0;
    std::array<double, 3> translation{};
    double agreement = 0.0;  ///< of the shape's links to others in the frame, 0 .. 1; docs/formats.md
    double residual = 0.0;   ///< of the links that agree: their length in the frame
    bool reflected = false;  ///< whether the rotation mirrors the shape
    bool found = false;      ///< whether links say how the shape stands; else the rotation is a guess
};

/// What alignment.json holds (docs/formats.md).
struct Alignment {
    bool aligned = false;         ///< if not, all rotations are the identity: shapes stand as they were given
    std::string reason;           ///< why they are aligned, or are not
    double standing_share = 0.0;  ///< share of the shapes that stand like the others as they were given
    double agreement_before = 0.0;
    double agreement_after = 0.0;
    std::vector<ShapeTransform> shapes;  ///< in the order of the shapes; set aside: nothing is done
};

/// What is needed to label more shapes like those of a run.
class Model;

struct Segmentation {
    int parts = 0;
    std::vector<ShapeLabels> shapes;  ///< in the order of the shapes that were given
    Certificate certificate;
    std::vector<std::string> warnings;   ///< of the whole call, one sentence each
    std::string report;                  ///< JSON, as in report.json (docs/formats.md)
    std::shared_ptr<const Model> model;  ///< of segment() alone, where SegmentOptions::keep_model is set
    Alignment alignment;                 ///< of assign(): to stand like the shapes of the run
};

/// As SegmentOptions::parts: 2 to 12, found from the shapes, as by --parts auto.
inline constexpr int automatic_parts = -1;

struct SegmentOptions {
    int parts = 0;                ///< K, 1 .. 1000, or automatic_parts
    std::vector<Option> options;  ///< see option_names()
    bool strict = true;           ///< a shape that cannot be used ends the call; otherwise it is set aside
    bool keep_model = true;
    std::string folder;    ///< where results are written as `coseg run --out` does; empty: nowhere
    bool replace = false;  ///< earlier results in the folder are replaced, as by --force
    /// A folder that keeps what is computed, as of --state; empty: none. With one, SIGUSR1 and SIGTERM end
    /// the call with code 75 and the state written.
    std::string state;
};

/// Cuts shapes into the same parts: the same number means the same part in every shape. Collective. Failure:
/// 2 an option or the number of parts, 3 a shape that cannot be used (its index, counted from 0, and its face
/// are named), fewer patches than parts, 4 the folder. Where a limit ends the optimiser before its gap, the
/// result is given all the same, with certificate.reached = false.
COSEG_VISIBLE Segmentation segment(std::span<const Shape> shapes, const SegmentOptions& options,
                                   const Call& call = {});

/// The model that a run of the program left in its folder. Collective. Failure: 3.
COSEG_VISIBLE std::shared_ptr<const Model> load_model(const std::string& folder, const Call& call = {});

struct AssignOptions {
    bool strict = true;
    std::string folder;
    bool replace = false;
    std::string state = "";
    /// A folder with NAME.seg for some of the new shapes: one part of the run for each face, or -1 where
    /// nothing is said. These faces keep their parts, and new shapes that are like them follow. Empty: none.
    std::string examples = "";
};

/// Labels new shapes like those of the run that left the model, without solving it again. Collective.
/// Failure as of segment().
COSEG_VISIBLE Segmentation assign(std::span<const Shape> shapes, const std::shared_ptr<const Model>& model,
                                  const AssignOptions& options = {}, const Call& call = {});

// ---- Descriptors ----

/// Values of the faces of one shape.
struct NamedFaceValues {
    std::string name;            ///< of the descriptor: shape_diameter ...
    int dimensions = 1;          ///< d: values a face
    std::vector<double> values;  ///< F x d, face by face
};

struct ShapeDescription {
    std::string name;
    std::vector<double> areas;  ///< F: of each face, in the square of the mesh's unit
    std::vector<NamedFaceValues> descriptors;
};

/// The descriptors of every face, free of scale (in the unit in which the shape's area is 1), before patches
/// average them. Where a face was cut into pieces inside the program, the value is the mean of the pieces
/// weighted by area; a face without area has that of the face from which it would take its label. `options`
/// as of segment(); the descriptors are those with a positive weight by default or in "feature-weights".
/// Collective. Failure: 2, 3.
COSEG_VISIBLE std::vector<ShapeDescription> describe(std::span<const Shape> shapes,
                                                     const std::vector<Option>& options = {},
                                                     const Call& call = {});

// ---- Matrices ----

/// One feature of N items: item by item d values, all >= 0 and finite, and not all 0.
struct FeatureMatrix {
    std::span<const double> values;  ///< N x d
    int dimensions = 0;              ///< d
};

struct ClusterSettings {
    int parts = 0;            ///< K, 1 .. N
    std::vector<int> groups;  ///< N, from 0, or empty: items of one group are not linked to each other
    bool unit_items = false;  ///< every item of every feature is scaled to norm 1 first
    double alpha = 0.01;      ///< weight of the l2,1 penalty: consistency over the features; >= 0
    double beta = 0.1;        ///< weight of the l1 penalty: sparseness; >= 0
    double lambda = 1.0;      ///< weight of the squared sums; >= 0
    std::string variant = "multi-feature";  ///< as of `coseg cluster --variant`
    std::string scope = "auto";             ///< auto, rows or meshes (groups)
    std::string affinity = "formula-8";     ///< formula-8 or links
    int links = 0;           ///< other groups in which an item may have matches; 0: all, else at least 2
    std::uint64_t seed = 1;  ///< of the sample of links
    double gap = 1e-4;       ///< relative duality gap at which the optimiser stops
    int max_iterations = 10000;
    double max_seconds = 3600.0;
};

/// A sparse N x N matrix, compressed by rows or by columns as its owner says.
struct SparseMatrix {
    std::int64_t size = 0;              ///< N
    std::vector<std::int64_t> offsets;  ///< N + 1
    std::vector<int> indices;
    std::vector<double> values;
};

struct Clusters {
    std::vector<int> labels;  ///< N, 0 .. parts - 1
    Certificate certificate;
    std::string report;                      ///< JSON: the certificate with the sizes of the problem
    std::vector<SparseMatrix> coefficients;  ///< W of each feature, by columns: item j is made of the rows
    SparseMatrix affinity;                   ///< symmetric, as it is cut; by rows
};

/// Multi-view subspace clustering of any data, as `coseg cluster` does it. Collective. Failure: 2, 3 (feature
/// and item are named, both counted from 1).
COSEG_VISIBLE Clusters cluster(const std::vector<FeatureMatrix>& features, const ClusterSettings& settings,
                               const Call& call = {});

}  // namespace interface_1
}  // namespace coseg
