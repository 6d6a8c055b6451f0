#include "mpi_drivers/editing/corrected_cut.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "io/data_files/correction_file.hpp"
#include "mpi_drivers/describe/patch_gather.hpp"
#include "mpi_drivers/editing/linked_places.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "mpi_drivers/partition/example_stage.hpp"
#include "solvers/partition/patch_partition.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

std::string named_act(const std::vector<Correction>& acts, int act) {
    if (act < 0) return "an example";
    const Correction& c = acts[at(act)];
    return c.where + " (" + summary_of(c) + ")";
}

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

/// What the rank that holds a place's mesh knows of it.
struct PlaceFacts {
    int place = 0;
    int patch = 0;  ///< global number
    int said = -1;
    int act = -1;
    static constexpr auto fields() {
        return std::tuple(field("place", &PlaceFacts::place), field("patch", &PlaceFacts::patch),
                          field("said", &PlaceFacts::said), field("act", &PlaceFacts::act));
    }
};

/// The places of all links, each once.
class Places {
  public:
    explicit Places(const CorrectionState& state) {
        for (const Correction& link : state.links()) {
            const bool same = link.kind == CorrectionKind::must_link;
            links_.push_back({number_of(state, link.first), number_of(state, link.second), same,
                              link.where + " (" + summary_of(link) + ")"});
        }
    }

    [[nodiscard]] const std::vector<PlaceLink>& links() const { return links_; }

    /// Fills in what the ranks know. Collective.
    void find(const Comm& comm, const CorrectionBase& base, const CorrectionState& state) {
        std::vector<PlaceFacts> local;
        agree(comm, [&] {
            for (std::size_t k = 0; k < state.said().size(); ++k) add_local(base, state, k, local);
        });
        facts_ = all_gather_records(comm, local);
        std::sort(facts_.begin(), facts_.end(),
                  [](const PlaceFacts& a, const PlaceFacts& b) { return a.place < b.place; });
    }

    [[nodiscard]] std::vector<LinkedPlace> with_scores(const Eigen::MatrixXd& scores,
                                                       const std::vector<Correction>& acts) const {
        std::vector<LinkedPlace> places;
        for (const PlaceFacts& fact : facts_)
            places.push_back(
                {mesh_[at(fact.place)], fact.said, named_act(acts, fact.act), scores.col(fact.patch)});
        return places;
    }

    /// Adds the parts of all places to what is said of patches and faces; patches first, so that a face
    /// inside of one keeps its own.
    void say(const CorrectionBase& base, const std::vector<int>& parts, const std::vector<double>& patch_area,
             CorrectedCut& result) const {
        for (const PlaceFacts& fact : facts_)
            result.said_area(parts[at(fact.place)], fact.patch) += patch_area[at(fact.patch)];
        for (const bool patches : {true, false}) {
            for (std::size_t k = 0; k < base.collection.local.size(); ++k) {
                for (const PlaceFacts& fact : facts_) {
                    const CorrectedPlace& place = place_[at(fact.place)];
                    if (mesh_[at(fact.place)] != base.collection.local[k].mesh || (place.face < 0) != patches)
                        continue;
                    say_faces(base.collection.local[k], place, parts[at(fact.place)], result.faces[k]);
                }
            }
        }
    }

  private:
    int number_of(const CorrectionState& state, const CorrectedPlace& place) {
        for (std::size_t p = 0; p < place_.size(); ++p) {
            if (place_[p] == place) return static_cast<int>(p);
        }
        place_.push_back(place);
        mesh_.push_back(state.mesh_of(place.shape, "a link"));
        return static_cast<int>(place_.size()) - 1;
    }

    void add_local(const CorrectionBase& base, const CorrectionState& state, std::size_t k,
                   std::vector<PlaceFacts>& local) const {
        const MeshDescription& mesh = base.collection.local[k];
        if (std::find(mesh_.begin(), mesh_.end(), mesh.mesh) == mesh_.end()) return;
        const std::vector<int> patch = patch_of_input_face(mesh);
        const int first = base.collection.numbering.first(mesh.mesh, 0);
        const SaidFaces& said = state.said()[k];
        for (std::size_t p = 0; p < place_.size(); ++p) {
            if (mesh_[p] != mesh.mesh) continue;
            const CorrectedPlace& place = place_[p];
            PlaceFacts fact{static_cast<int>(p),
                            first + (place.face >= 0 ? patch[at(place.face)] : place.patch), -1, -1};
            for (std::size_t f = 0; f < said.part.size(); ++f) {
                const bool is_in =
                    place.face >= 0 ? static_cast<int>(f) == place.face : patch[f] == place.patch;
                if (!is_in || said.part[f] < 0 || fact.said >= 0) continue;
                fact.said = said.part[f];
                fact.act = said.act[f];
            }
            local.push_back(fact);
        }
    }

    static void say_faces(const MeshDescription& mesh, const CorrectedPlace& place, int part,
                          std::vector<int>& faces) {
        if (faces.empty()) faces.assign(at(mesh.map.input_faces), -1);
        if (place.face >= 0) {
            faces[at(place.face)] = part;
            return;
        }
        const std::vector<int> patch = patch_of_input_face(mesh);
        for (std::size_t f = 0; f < faces.size(); ++f) {
            if (patch[f] == place.patch && faces[f] < 0) faces[f] = part;
        }
    }

    std::vector<CorrectedPlace> place_;
    std::vector<int> mesh_;
    std::vector<PlaceLink> links_;
    std::vector<PlaceFacts> facts_;
};

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
            Places places(state);
            places.find(comm, base, state);
            agree(comm, [&] {
                places.say(base,
                           parts_of_places(places.with_scores(scores, acts), places.links(), said.allowed,
                                           reasons(state, acts)),
                           parts.objective().area, result);
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
