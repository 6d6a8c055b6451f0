// coseg::segment and coseg::assign.

#include <coseg/coseg.hpp>
#include <span>
#include <tuple>
#include <utility>

#include "mpi_drivers/assignment.hpp"
#include "mpi_drivers/co_segmentation.hpp"
#include "mpi_drivers/interface/certificates.hpp"
#include "mpi_drivers/interface/collection_shapes.hpp"
#include "mpi_drivers/interface/library_call.hpp"
#include "mpi_drivers/optimise/solution_output.hpp"
#include "mpi_drivers/options/named_options.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"
#include "src/records/part_limits.hpp"

namespace coseg {

class interface_1::Model {
  public:
    Model(RunModel kept, std::string origin) : run(std::move(kept)), name(std::move(origin)) {}
    RunModel run;
    std::string name;  ///< what messages call it
};

namespace {

/// The labels of a mesh, for ranks that do not hold it.
struct ToldLabels {
    int mesh = 0;
    std::vector<int> part;
    std::vector<int> patch;
    std::vector<double> part_area;
    static constexpr auto fields() {
        return std::tuple(field("mesh", &ToldLabels::mesh), field("part", &ToldLabels::part),
                          field("patch", &ToldLabels::patch), field("part_area", &ToldLabels::part_area));
    }
};

/// The labels of usable meshes, by their number in the collection, on all ranks. Collective.
std::vector<ToldLabels> all_labels(const Comm& comm, std::vector<MeshLabels> labels, std::size_t meshes) {
    std::vector<ToldLabels> local;
    for (MeshLabels& mesh : labels)
        local.push_back({mesh.mesh, std::move(mesh.part), std::move(mesh.patch), std::move(mesh.part_area)});
    std::vector<ToldLabels> all(meshes);
    for (ToldLabels& mesh : all_gather_records(comm, local)) {
        const auto number = at(mesh.mesh);
        all[number] = std::move(mesh);
    }
    return all;
}

/// Puts what the stages say of meshes into the order of the caller. Both lists of the collection ascend.
std::vector<ShapeLabels> in_order(const CollectionShapes& shapes, const Collection& collection,
                                  std::vector<ToldLabels> labels) {
    std::vector<ShapeLabels> result(shapes.entries().size());
    auto set_aside = collection.set_aside.begin();
    std::size_t mesh = 0;
    for (std::size_t k = 0; k < result.size(); ++k) {
        const MeshEntry& entry = shapes.entries()[k];
        ShapeLabels& shape = result[shapes.index_of(k)];
        shape.name = entry.name;
        if (set_aside != collection.set_aside.end() && set_aside->path == entry.path) {
            shape.set_aside = (set_aside++)->reason;
            continue;
        }
        shape.labels = std::move(labels[mesh].part);
        shape.patches = std::move(labels[mesh].patch);
        shape.part_areas = std::move(labels[mesh].part_area);
        shape.warnings = collection.meshes[mesh++].warnings;
    }
    return result;
}

ShapeTransform transform_of(const AlignedShape& shape) {
    ShapeTransform transform;
    for (std::size_t k = 0; k < 9; ++k)
        transform.rotation[k] =
            shape.rotation(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3));
    transform.scale = shape.scale;
    for (std::size_t k = 0; k < 3; ++k)
        transform.translation[k] = shape.translation[static_cast<Eigen::Index>(k)];
    transform.agreement = shape.agreement;
    transform.residual = shape.residual;
    transform.reflected = shape.reflected;
    transform.found = shape.found;
    return transform;
}

/// `result.shapes` say which shapes are set aside.
void add_alignment(const CollectionShapes& shapes, const AlignmentFile& alignment, Segmentation& result) {
    result.alignment = {alignment.aligned,          alignment.reason,          alignment.standing_share,
                        alignment.agreement_before, alignment.agreement_after, {}};
    result.alignment.shapes.resize(result.shapes.size());
    auto usable = alignment.shapes.begin();
    for (std::size_t k = 0; k < result.shapes.size(); ++k) {
        const std::size_t index = shapes.index_of(k);
        if (result.shapes[index].set_aside.empty()) result.alignment.shapes[index] = transform_of(*usable++);
    }
}

void add_solution(Segmentation& result, const SolveResult& solution, double gap) {
    result.certificate = certificate_of(solution);
    if (const auto sentence = unreached_gap(solution, gap, "the optimiser")) {
        result.certificate.reached = false;
        result.warnings.push_back(*sentence);
    }
}

ContentHash content_of(const SegmentOptions& given) {
    ContentHasher hasher;
    hasher.add(given.parts);
    add_options(hasher, given.options);
    for (const bool is_set : {given.strict, given.keep_model, given.replace}) hasher.add(is_set);
    hasher.add(given.folder);
    hasher.add(given.state);
    return hasher.result();
}

ContentHash content_of(const AssignOptions& given) {
    ContentHasher hasher;
    for (const bool is_set : {given.strict, given.replace}) hasher.add(is_set);
    for (const std::string* text : {&given.folder, &given.state, &given.examples}) hasher.add(*text);
    return hasher.result();
}

/// By what a later mesh is labelled, but for the values of the features.
ContentHash content_of(const RunModel& model) {
    ContentHasher hasher;
    hasher.add(model.options.partition.parts);
    hasher.add(model.options.description.seed);
    hasher.add(std::span<const int>(model.part_of_patch));
    hasher.add(std::span<const int>(model.mesh_of));
    for (const std::string& name : model.mesh_names) hasher.add(name);
    return hasher.result();
}

RunOptions run_options(const SegmentOptions& given) {
    RunOptions options = options_by_name(given.options);
    if (given.parts != automatic_parts && (given.parts < 1 || given.parts > most_parts))
        throw Error(ExitCode::usage, "parts: " + std::to_string(given.parts) + " is not in 1 .. " +
                                         std::to_string(most_parts));
    options.partition.parts = given.parts == automatic_parts ? found_parts : given.parts;
    options.output.keep_model = given.keep_model;
    options.output.folder = given.folder;
    options.output.force = given.replace;
    options.process.strict = given.strict;
    options.process.state = given.state;
    options.process.watches_signals = false;
    return options;
}

Segmentation segmented(LibraryCall& library, std::span<const Shape> given, const SegmentOptions& settings) {
    const Comm& comm = library.comm();
    refuse_differences(comm, content_of(settings), "options");
    RunOptions options;
    agree(comm, [&] { options = run_options(settings); });
    const CollectionShapes shapes(comm, given);
    CoSegmented done = co_segment(comm, &shapes.entries(), options, {}, library.log());
    Segmentation result;
    result.parts = done.options.partition.parts;
    result.warnings = library.warnings();
    add_solution(result, done.optimisation.result, options.optimise.gap);
    if (settings.keep_model)
        result.model = std::make_shared<const Model>(
            run_model(done.collection, done.model, done.cut.part_of_patch, done.options), "the model");
    result.report = std::move(done.report);
    broadcast(comm, result.report);
    result.shapes = in_order(shapes, done.collection,
                             all_labels(comm, std::move(done.labels), done.collection.meshes.size()));
    add_alignment(shapes, done.alignment, result);
    return result;
}

Segmentation assigned(LibraryCall& library, std::span<const Shape> given, const Model& model,
                      const AssignOptions& settings) {
    const Comm& comm = library.comm();
    refuse_differences(comm, content_of(settings), "options");
    refuse_differences(comm, content_of(model.run), "models");
    const CollectionShapes shapes(comm, given);
    RunOptions own;
    own.output.folder = settings.folder;
    own.output.force = settings.replace;
    own.process.strict = settings.strict;
    own.process.state = settings.state;
    own.partition.examples = settings.examples;
    own.process.watches_signals = false;
    AssignedLabels done = assign(comm, &shapes.entries(), model.run, model.name, own, library.log());
    Segmentation result;
    result.parts = done.parts;
    result.warnings = library.warnings();
    add_solution(result, done.assigned.optimisation.result, model.run.options.optimise.gap);
    result.report = std::move(done.report);
    broadcast(comm, result.report);
    result.shapes = in_order(shapes, done.collection,
                             all_labels(comm, std::move(done.labels), done.collection.meshes.size()));
    add_alignment(shapes, done.alignment, result);
    return result;
}

}  // namespace

Segmentation interface_1::segment(std::span<const Shape> shapes, const SegmentOptions& options,
                                  const Call& call) {
    return in_call(call, [&](LibraryCall& library) { return segmented(library, shapes, options); });
}

std::shared_ptr<const Model> interface_1::load_model(const std::string& folder, const Call& call) {
    return in_call(call, [&](LibraryCall& library) {
        ContentHasher hasher;
        hasher.add(folder);
        refuse_differences(library.comm(), hasher.result(), "folders");
        return std::make_shared<const Model>(agreed_run_model(library.comm(), folder, library.log()), folder);
    });
}

Segmentation interface_1::assign(std::span<const Shape> shapes, const std::shared_ptr<const Model>& model,
                                 const AssignOptions& options, const Call& call) {
    return in_call(call, [&](LibraryCall& library) {
        agree(library.comm(), [&] {
            if (model == nullptr)
                throw Error(ExitCode::usage,
                            "assign() was given no model; segment() gives one with keep_model");
        });
        return assigned(library, shapes, *model, options);
    });
}

}  // namespace coseg
