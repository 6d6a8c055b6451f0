#include "mpi_drivers/editing/corrected_cut.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "io/data_files/correction_file.hpp"
#include "mpi_drivers/describe/patch_gather.hpp"
#include "mpi_drivers/editing/places_of_links.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "mpi_drivers/partition/example_stage.hpp"
#include "solvers/partition/patch_partition.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

/// Faces that are said to have a part that their shape does not have.
void refuse_absent_labels(const CorrectionBase& base, const CorrectionState& state,
                          const std::vector<Correction>& acts) {
    for (std::size_t k = 0; k < state.said().size(); ++k) {
        const SaidFaces& said = state.said()[k];
        const int mesh = base.collection.local[k].mesh;
        for (std::size_t f = 0; f < said.part.size(); ++f) {
            if (said.part[f] < 0) continue;
            const int denied = state.absent()(said.part[f], mesh);
            if (denied < 0) continue;
            throw Error(ExitCode::input, named_act(acts, said.act[f]) + " and " + named_act(acts, denied) +
                                             " contradict each other: face " + std::to_string(f) + " of " +
                                             base.collection.meshes[at(mesh)].name + " has the part");
        }
    }
}

Eigen::MatrixXd gathered_areas(const Comm& comm, const CorrectionBase& base, const CorrectionState& state) {
    std::vector<Eigen::MatrixXd> local;
    agree(comm, [&] {
        for (std::size_t k = 0; k < state.said().size(); ++k) {
            const MeshDescription& mesh = base.collection.local[k];
            const std::vector<int>& said = state.said()[k].part;
            local.push_back(said.empty() ? Eigen::MatrixXd::Zero(state.part_count(),
                                                                 base.collection.numbering.count(mesh.mesh))
                                         : label_areas(mesh, said, state.part_count()));
        }
    });
    return gather_patch_columns(comm, base.collection, local, state.part_count());
}

/// 1 where a mesh may have a part: a live one of which a patch or something said is known, and that is not
/// absent there.
Eigen::MatrixXi allowed_parts(const CorrectionState& state, const std::vector<int>& base,
                              const Eigen::MatrixXd& said_area) {
    Eigen::MatrixXi allowed = (state.absent().array() < 0).cast<int>();
    std::vector<bool> is_known(at(state.part_count()), false);
    for (const int part : base) is_known[at(part)] = true;
    for (int part = 0; part < state.part_count(); ++part) {
        const bool is_said = said_area.row(part).maxCoeff() > 0.0;
        if (!state.is_live(part) || !(is_known[at(part)] || is_said)) allowed.row(part).setZero();
    }
    return allowed;
}

void refuse_shapes_without_parts(const CorrectionBase& base, const CorrectionState& state,
                                 const std::vector<Correction>& acts, const Eigen::MatrixXi& allowed) {
    for (Eigen::Index m = 0; m < allowed.cols(); ++m) {
        if (allowed.col(m).maxCoeff() > 0) continue;
        std::vector<int> denied;
        for (Eigen::Index part = 0; part < allowed.rows(); ++part) {
            if (state.absent()(part, m) >= 0) denied.push_back(state.absent()(part, m));
        }
        std::sort(denied.rbegin(), denied.rend());
        throw Error(ExitCode::input,
                    named_act(acts, denied.front()) + " and " +
                        (denied.size() > 1 ? named_act(acts, denied[1]) : "having one part alone") +
                        " contradict each other: " + base.collection.meshes[at(m)].name +
                        " has no part left");
    }
}

std::vector<std::vector<std::string>> reasons(const CorrectionState& state,
                                              const std::vector<Correction>& acts) {
    std::vector<std::vector<std::string>> why(at(state.part_count()));
    for (int part = 0; part < state.part_count(); ++part) {
        for (Eigen::Index m = 0; m < state.absent().cols(); ++m) {
            const int act = state.absent()(part, m);
            why[at(part)].push_back(act >= 0 ? named_act(acts, act) : "");
        }
    }
    return why;
}

}  // namespace

std::unique_ptr<CorrectedParts> corrected_parts_of(const Comm& comm, const CorrectionBase& base,
                                                   const SolvedPatches& patches,
                                                   const PartitionOptions& options) {
    PartitionInput input =
        partition_input(comm, base.collection, patches.features, patches.coefficients, options);
    // What is said is learnt from the features, also where the parts were not chosen by them.
    if (!options.choose) input.features = {comm, patches.features.histograms};
    const std::vector<int> mesh_of = base.collection.numbering.mesh_of();
    const std::vector<GlobalPatchNeighbors> neighbors = local_neighbors(base.collection);
    const std::vector<GlobalPatchOverlap> overlaps = local_overlaps(base.collection);
    const std::vector<ChoiceDescriptor> choice = input.choice();
    return std::make_unique<CorrectedParts>(
        comm,
        CutInput{patches.coefficients, neighbors, overlaps, mesh_of, input.patch_area, choice,
                 input.known_positions(), nullptr, &input.features},
        cut_options(input, options), base.cut.confidence);
}

CorrectionState state_after(const Comm& comm, const CorrectionBase& base,
                            const std::vector<Correction>& acts) {
    CorrectionState state(base);
    agree(comm, [&] {
        for (std::size_t k = 0; k < acts.size(); ++k) state.apply(acts[k], static_cast<int>(k));
    });
    return state;
}

CorrectedCut corrected_cut(const Comm& comm, const CorrectionBase& base, const CorrectionState& state,
                           const std::vector<Correction>& acts, const CorrectedParts& parts) {
    CorrectedCut result{base.cut, {}, {}};
    for (const SaidFaces& said : state.said()) result.faces.push_back(said.part);
    result.cut.part_of_patch = state.base_parts();
    agree(comm, [&] { refuse_absent_labels(base, state, acts); });
    result.said_area = gathered_areas(comm, base, state);
    if (state.says_something()) {
        SaidParts said{state.base_parts(), result.said_area,
                       allowed_parts(state, state.base_parts(), result.said_area)};
        agree(comm, [&] { refuse_shapes_without_parts(base, state, acts, said.allowed); });
        Eigen::MatrixXd scores;
        agree(comm, [&] { scores = parts.scores(said); });
        if (!state.links().empty()) {
            PlacesOfLinks places(state);
            places.find(comm, base, state);
            agree(comm, [&] {
                places.say(base,
                           parts_of_places(places.with_scores(scores, acts), places.links(), said.allowed,
                                           reasons(state, acts)),
                           parts.objective().area, result.said_area, result.faces);
                said.area = result.said_area;
                scores = parts.scores(said);
            });
        }
        CorrectedPartition corrected = parts.corrected(comm, said, scores);
        result.cut.part_of_patch = std::move(corrected.parts);
        result.cut.confidence = std::move(corrected.confidence);
        result.cut.scores = scores.cast<float>();
    } else if (result.cut.part_of_patch != base.cut.part_of_patch) {
        result.cut.scores = {};  // those of the base are of other parts
    }
    describe_parts(base.collection.numbering.mesh_of(), parts.objective().area, state.part_count(),
                   result.cut);
    result.cut.tree = {};
    return result;
}

}  // namespace coseg
