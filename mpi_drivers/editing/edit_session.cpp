#include "mpi_drivers/editing/edit_session.hpp"

#include <algorithm>
#include <filesystem>
#include <queue>
#include <utility>

#include "io/data_files/label_file.hpp"
#include "io/files/file_contents.hpp"
#include "io/folders/state_folder.hpp"
#include "solvers/partition/part_confidence.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/mesh/polygon_edges.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

/// Faces of the same label that hang together with `face` over common edges, ascending.
std::vector<int> piece_with(const PolygonMesh& mesh, const std::vector<int>& labels, int face) {
    std::vector<int> vertex(at(mesh.vertex_count()));
    for (std::size_t v = 0; v < vertex.size(); ++v) vertex[v] = static_cast<int>(v);
    const PolygonHalfEdges edges = polygon_half_edges(mesh, vertex);
    std::vector<std::pair<std::pair<int, int>, int>> by_edge;  // ends in order, and the face
    for (std::size_t h = 0; h < edges.face.size(); ++h)
        by_edge.push_back({std::minmax(edges.from[h], edges.to[h]), edges.face[h]});
    std::sort(by_edge.begin(), by_edge.end());
    std::vector<std::vector<int>> touching(labels.size());
    for (std::size_t h = 1; h < by_edge.size(); ++h) {
        if (by_edge[h].first != by_edge[h - 1].first) continue;
        touching[at(by_edge[h].second)].push_back(by_edge[h - 1].second);
        touching[at(by_edge[h - 1].second)].push_back(by_edge[h].second);
    }
    std::vector<bool> is_in(labels.size(), false);
    std::queue<int> waiting;
    waiting.push(face);
    is_in[at(face)] = true;
    std::vector<int> piece;
    for (; !waiting.empty(); waiting.pop()) {
        piece.push_back(waiting.front());
        for (const int other : touching[at(waiting.front())]) {
            if (is_in[at(other)] || labels[at(other)] != labels[at(face)]) continue;
            is_in[at(other)] = true;
            waiting.push(other);
        }
    }
    std::sort(piece.begin(), piece.end());
    return piece;
}

/// MeshLabels as ranks send them.
struct SentLabels {
    std::vector<int> part;
    std::vector<int> patch;
    std::vector<double> part_area;
    static constexpr auto fields() {
        return std::tuple(field("part", &SentLabels::part), field("patch", &SentLabels::patch),
                          field("part_area", &SentLabels::part_area));
    }
};

void refuse_unknown_shape(const Collection& collection, int mesh) {
    if (mesh < 0 || mesh >= static_cast<int>(collection.meshes.size()))
        throw Error(ExitCode::usage, "there is no shape " + std::to_string(mesh));
}

void rename_acts(CorrectionFile& file) {
    for (std::size_t k = 0; k < file.acts.size(); ++k) file.acts[k].where = "act " + std::to_string(k + 1);
}

}  // namespace

EditSession::EditSession(const Comm& comm, const CorrectionBase& base, std::unique_ptr<CorrectedParts> parts,
                         RefineMode refine, std::string path)
    : comm_(comm), base_(base), parts_(std::move(parts)), refine_(refine), path_(std::move(path)) {
    local_.resize(base_.collection.local.size());
    const std::string run = base_hash(base_);
    agree(comm_, [&] {
        if (!comm_.is_root()) return;
        file_.run = run;
        require_regular_file(path_);
        if (std::filesystem::exists(path_)) file_ = read_corrections(path_);
        if (file_.run != run)
            throw Error(ExitCode::input, path_ +
                                             ": is about another run; move it away, or name the run that it "
                                             "belongs to");
    });
    broadcast(comm_, file_.run);
    broadcast(comm_, file_.acts);
    broadcast(comm_, file_.undone);
    take(file_);
}

EditSession::Now EditSession::now_after(const std::vector<Correction>& acts) const {
    CorrectionState state = state_after(comm_, base_, acts);
    CorrectedCut corrected = corrected_cut(comm_, base_, state, acts, *parts_);
    return {std::move(state), std::move(corrected)};
}

/// Follows the acts of a file and writes it; only then they are the session's.
void EditSession::take(CorrectionFile file) {
    rename_acts(file);
    auto next = std::make_unique<Now>(now_after(file.acts));
    agree(comm_, [&] {
        if (comm_.is_root()) write_corrections(path_, file);
    });
    CutResult& cut_now = next->corrected.cut;
    if (cut_now.confidence.empty())
        cut_now.confidence =
            part_confidence(parts_->objective(), {}, cut_now.part_of_patch, next->state.part_count());
    find_changes(*next);
    now_ = std::move(next);
    file_ = std::move(file);
    ++revision_;
    questions_ = open_questions(parts_->objective(), cut().confidence, state().confirmed());
}

/// Fills changed_, and forgets the labels of local shapes that changed.
void EditSession::find_changes(const Now& next) {
    changed_.clear();
    if (now_ == nullptr) return;
    const Now& before = *now_;
    const PatchNumbering& numbering = base_.collection.numbering;
    std::vector<int> said_local;  // meshes of which something else is said
    for (std::size_t k = 0; k < local_.size(); ++k) {
        if (before.corrected.faces[k] != next.corrected.faces[k])
            said_local.push_back(base_.collection.local[k].mesh);
    }
    const std::vector<int> said = all_gather(comm_, std::span<const int>(said_local));
    const bool is_renumbered = before.state.part_count() != next.state.part_count();
    for (int m = 0; m < static_cast<int>(base_.collection.meshes.size()); ++m) {
        const auto first = numbering.first(m, 0);
        const auto count = numbering.count(m);
        const bool has_moved = !std::equal(before.corrected.cut.part_of_patch.begin() + first,
                                           before.corrected.cut.part_of_patch.begin() + first + count,
                                           next.corrected.cut.part_of_patch.begin() + first);
        const bool is_said = std::find(said.begin(), said.end(), m) != said.end();
        if (has_moved || is_said || before.state.confirmed()[at(m)] != next.state.confirmed()[at(m)])
            changed_.push_back(m);
    }
    for (std::size_t k = 0; k < local_.size(); ++k) {
        if (is_renumbered ||
            std::binary_search(changed_.begin(), changed_.end(), base_.collection.local[k].mesh))
            local_[k] = nullptr;
    }
}

void EditSession::act(Correction correction) {
    CorrectionFile file = file_;
    const bool replaces_level = correction.kind == CorrectionKind::level && file.acts.size() == 1 &&
                                file.acts.front().kind == CorrectionKind::level;
    if (replaces_level) file.acts.clear();
    file.acts.push_back(std::move(correction));
    file.undone.clear();
    take(std::move(file));
}

void EditSession::undo() {
    if (file_.acts.empty()) throw AgreedError(ExitCode::usage, "there is nothing to undo");
    CorrectionFile file = file_;
    file.undone.push_back(std::move(file.acts.back()));
    file.acts.pop_back();
    take(std::move(file));
}

void EditSession::redo() {
    if (file_.undone.empty()) throw AgreedError(ExitCode::usage, "there is nothing to do again");
    CorrectionFile file = file_;
    file.acts.push_back(std::move(file.undone.back()));
    file.undone.pop_back();
    take(std::move(file));
}

const MeshLabels& EditSession::local_labels(std::size_t k) {
    if (local_[k] == nullptr)
        local_[k] = std::make_unique<MeshLabels>(
            labels_of_mesh(base_.collection.local[k], base_.collection.numbering, cut(), state().part_count(),
                           refine_, now_->corrected.faces[k]));
    return *local_[k];
}

MeshLabels EditSession::labels(int mesh) {
    std::vector<SentLabels> mine;
    agree(comm_, [&] {
        for (std::size_t k = 0; k < local_.size(); ++k) {
            if (base_.collection.local[k].mesh != mesh) continue;
            const MeshLabels& labels = local_labels(k);
            mine.push_back({labels.part, labels.patch, labels.part_area});
        }
    });
    std::vector<SentLabels> all = all_gather_records(comm_, mine);
    if (all.size() != 1) throw AgreedError(ExitCode::internal, "a shape is held by no rank");
    return {.mesh = mesh,
            .part = std::move(all.front().part),
            .patch = std::move(all.front().patch),
            .confidence = {},
            .part_area = std::move(all.front().part_area)};
}

void EditSession::write_all_labels(const std::string& folder) {
    agree(comm_, [&] {
        for (std::size_t k = 0; k < local_.size(); ++k) {
            const std::string& name = base_.collection.meshes[at(base_.collection.local[k].mesh)].name;
            const std::string path = folder + "/" + name + label_suffix;
            make_parent_folders(path);
            write_labels(path, local_labels(k).part);
        }
    });
}

Correction EditSession::label_of_region(int mesh, int face, FaceRegion region, int part) {
    Correction correction;
    correction.kind = CorrectionKind::label;
    correction.part = part;
    agree(comm_, [&] {
        refuse_unknown_shape(base_.collection, mesh);
        const int faces = base_.collection.meshes[at(mesh)].input_faces;
        if (face < 0 || face >= faces)
            throw Error(ExitCode::usage, "the shape has " + std::to_string(faces) + " faces, counted from 0");
    });
    correction.shape = base_.collection.meshes[at(mesh)].name;
    if (region == FaceRegion::face) {
        correction.faces = {{face, face}};
        return correction;
    }
    std::vector<std::vector<int>> mine;
    agree(comm_, [&] {
        for (std::size_t k = 0; k < local_.size(); ++k) {
            if (base_.collection.local[k].mesh != mesh) continue;
            const MeshLabels& labels = local_labels(k);
            if (region == FaceRegion::patch)
                mine.push_back({labels.patch[at(face)]});
            else
                mine.push_back(piece_with(base_.collection.local[k].input, labels.part, face));
        }
    });
    (region == FaceRegion::patch ? correction.patches : correction.faces) =
        ranges_of(all_gather_records(comm_, mine).front());
    return correction;
}

Correction EditSession::confirmation_of(int mesh) {
    Correction correction;
    correction.kind = CorrectionKind::confirm;
    agree(comm_, [&] { refuse_unknown_shape(base_.collection, mesh); });
    correction.shape = base_.collection.meshes[at(mesh)].name;
    correction.labels = runs_of(labels(mesh).part);
    return correction;
}

std::vector<double> EditSession::confidence() const {
    const PartitionObjective& objective = parts_->objective();
    std::vector<double> mean(base_.collection.meshes.size(), 0.0);
    for (std::size_t i = 0; i < objective.mesh_of.size(); ++i)
        mean[at(objective.mesh_of[i])] += objective.share[i] * cut().confidence[i];
    for (double& m : mean) m = std::min(m, 1.0);  // shares sum to 1 but for rounding
    return mean;
}

}  // namespace coseg
