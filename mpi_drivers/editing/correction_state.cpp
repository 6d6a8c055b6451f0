#include "mpi_drivers/editing/correction_state.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

#include "io/data_files/correction_file.hpp"
#include "io/files/content_hash.hpp"
#include "solvers/partition/part_levels.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/spelling.hpp"
#include "src/mesh/face_map.hpp"
#include "src/records/part_limits.hpp"

namespace coseg {

namespace {

/// A half of a part has at least this share of its patches, if there is such a half.
constexpr double least_half = 0.1;
/// Below this share a half is lost in the vote of the over-segmentations.
constexpr double fewest_of_half = 0.02;

/// Which pieces of the tree lead which, after its first `unions` unions.
std::vector<int> leads_after(const PartTree& tree, std::size_t unions) {
    std::vector<int> lead(at(tree.finest()));
    std::iota(lead.begin(), lead.end(), 0);
    for (std::size_t k = 0; k < unions; ++k)
        std::replace(lead.begin(), lead.end(), tree.unions[k].taken, tree.unions[k].kept);
    return lead;
}

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
    throw Error(ExitCode::input, where + ": " + what);
}

}  // namespace

std::string base_hash(const CorrectionBase& base) {
    ContentHasher hasher;
    for (const MeshFacts& mesh : base.collection.meshes) {
        hasher.add(mesh.name);
        hasher.add(std::int64_t{mesh.input_faces});
    }
    hasher.add(std::int64_t{base.parts});
    hasher.add(std::span<const int>(base.cut.part_of_patch));
    return hasher.result().hex();
}

std::vector<int> patch_of_input_face(const MeshDescription& mesh) {
    return carry_labels_back(mesh.map, mesh.patches.front(), mesh.geometry.area);
}

CorrectionState::CorrectionState(const CorrectionBase& base)
    : base_(base),
      is_live_(at(base.parts), true),
      base_parts_(base.cut.part_of_patch),
      said_(base.collection.local.size()),
      absent_(Eigen::MatrixXi::Constant(base.parts, static_cast<Eigen::Index>(base.collection.meshes.size()),
                                        -1)),
      confirmed_(base.collection.meshes.size(), false),
      names_(base.names) {
    for (std::size_t m = 0; m < base.collection.meshes.size(); ++m)
        mesh_of_name_.emplace(base.collection.meshes[m].name, static_cast<int>(m));
    for (std::size_t k = 0; k < base.examples.size(); ++k) {
        if (base.examples[k].empty()) continue;
        said_[k] = {base.examples[k], std::vector<int>(base.examples[k].size(), -1)};
    }
}

int CorrectionState::mesh_of(const std::string& shape, const std::string& where) const {
    const auto found = mesh_of_name_.find(shape);
    if (found != mesh_of_name_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [name, mesh] : mesh_of_name_) names.push_back(name);
    const std::string meant = nearest_word(shape, names);
    refuse(where, "no shape '" + shape + "' is segmented; it is not among the meshes, or it was set aside" +
                      (meant.empty() ? std::string() : "; did you mean " + meant + "?"));
}

void CorrectionState::require_live(int part, const std::string& where) const {
    if (part < 0 || part >= part_count())
        refuse(where, "there is no part " + std::to_string(part) + "; parts are 0 to " +
                          std::to_string(part_count() - 1));
    if (!is_live(part)) refuse(where, "part " + std::to_string(part) + " was merged into another one");
}

void CorrectionState::check_place(const CorrectedPlace& place, const std::string& where) const {
    const int mesh = mesh_of(place.shape, where);
    const int faces = base_.collection.meshes[at(mesh)].input_faces;
    const int patches = base_.collection.numbering.count(mesh, 0);
    if (place.face >= faces)
        refuse(where, place.shape + " has no face " + std::to_string(place.face) + "; it has " +
                          std::to_string(faces) + ", counted from 0");
    if (place.patch >= patches)
        refuse(where, place.shape + " has no patch " + std::to_string(place.patch) + "; it has " +
                          std::to_string(patches) + ", counted from 0");
}

/// Null where another rank holds the mesh.
SaidFaces* CorrectionState::said_of(int mesh) {
    for (std::size_t k = 0; k < said_.size(); ++k) {
        if (base_.collection.local[k].mesh != mesh) continue;
        const auto faces = at(base_.collection.meshes[at(mesh)].input_faces);
        if (said_[k].part.empty()) said_[k] = {std::vector<int>(faces, -1), std::vector<int>(faces, -1)};
        return &said_[k];
    }
    return nullptr;
}

void CorrectionState::apply(const Correction& c, int act) {
    switch (c.kind) {
        case CorrectionKind::label:
            say(c, act);
            break;
        case CorrectionKind::confirm:
            confirm(c, act);
            break;
        case CorrectionKind::merge:
            merge(c);
            break;
        case CorrectionKind::split:
            split(c);
            break;
        case CorrectionKind::new_part:
            add_part(c.where);
            break;
        case CorrectionKind::name:
            require_live(c.part, c.where);
            names_[c.part] = c.text;
            break;
        case CorrectionKind::color:
            require_live(c.part, c.where);
            colors_[c.part] = c.text;
            break;
        case CorrectionKind::absent:
            require_live(c.part, c.where);
            absent_(c.part, mesh_of(c.shape, c.where)) = act;
            says_something_ = true;
            break;
        case CorrectionKind::must_link:
        case CorrectionKind::cannot_link:
            check_place(c.first, c.where);
            check_place(c.second, c.where);
            links_.push_back(c);
            says_something_ = true;
            break;
        case CorrectionKind::level:
            take_level(c);
            break;
    }
    if (c.kind != CorrectionKind::level) is_untouched_ = false;
}

void CorrectionState::say(const Correction& c, int act) {
    require_live(c.part, c.where);
    const int mesh = mesh_of(c.shape, c.where);
    if (!c.faces.empty()) check_place({c.shape, c.faces.back().last, -1}, c.where);
    if (!c.patches.empty()) check_place({c.shape, -1, c.patches.back().last}, c.where);
    says_something_ = true;
    confirmed_[at(mesh)] = false;
    SaidFaces* said = said_of(mesh);
    if (said == nullptr) return;
    const auto set = [&](std::size_t face) {
        said->part[face] = c.part;
        said->act[face] = act;
    };
    for (const NumberRange& faces : c.faces) {
        for (int face = faces.first; face <= faces.last; ++face) set(at(face));
    }
    if (c.patches.empty()) return;
    const auto local = std::find_if(base_.collection.local.begin(), base_.collection.local.end(),
                                    [&](const MeshDescription& m) { return m.mesh == mesh; });
    const std::vector<int> patch = patch_of_input_face(*local);
    for (std::size_t f = 0; f < patch.size(); ++f) {
        if (contains(c.patches, patch[f])) set(f);
    }
}

void CorrectionState::confirm(const Correction& c, int act) {
    const int mesh = mesh_of(c.shape, c.where);
    const int faces = base_.collection.meshes[at(mesh)].input_faces;
    if (label_count(c.labels) != faces)
        refuse(c.where, "it has " + std::to_string(label_count(c.labels)) + " labels, but " + c.shape +
                            " has " + std::to_string(faces) + " faces");
    for (const LabelRun& run : c.labels) require_live(run.label, c.where);
    confirmed_[at(mesh)] = true;
    says_something_ = true;
    SaidFaces* said = said_of(mesh);
    if (said == nullptr) return;
    said->part = labels_of(c.labels);
    std::fill(said->act.begin(), said->act.end(), act);
}

void CorrectionState::merge(const Correction& c) {
    require_live(c.part, c.where);
    require_live(c.into, c.where);
    is_live_[at(c.part)] = false;
    std::replace(base_parts_.begin(), base_parts_.end(), c.part, c.into);
    for (SaidFaces& said : said_) std::replace(said.part.begin(), said.part.end(), c.part, c.into);
    absent_.row(c.part).setConstant(-1);
    names_.erase(c.part);
    colors_.erase(c.part);
}

void CorrectionState::add_part(const std::string& where) {
    if (part_count() >= most_parts)
        refuse(where, "there are " + std::to_string(most_parts) + " parts already");
    is_live_.push_back(true);
    absent_.conservativeResize(part_count(), Eigen::NoChange);
    absent_.bottomRows<1>().setConstant(-1);
}

/// Of each piece of the tree that the part has something of: 0 or 1, the half that it falls into; -1 of the
/// others. From the coarsest level on, the part falls into groups; the largest but one becomes a half at the
/// first level at which it has enough of the part's patches, or else where it has most. Empty where the part
/// hardly falls apart.
std::vector<int> CorrectionState::halves(int part) const {
    const PartTree& tree = base_.cut.tree;
    if (tree.empty()) return {};
    std::vector<int> patches(at(tree.finest()), 0);
    for (std::size_t i = 0; i < base_parts_.size(); ++i)
        patches[at(tree.piece_of_patch[i])] += base_parts_[i] == part ? 1 : 0;
    const int all = std::accumulate(patches.begin(), patches.end(), 0);
    std::vector<int> best;
    int best_count = 0;
    for (std::size_t left = 0; left <= tree.unions.size() && best_count < least_half * all; ++left) {
        const std::vector<int> lead = leads_after(tree, tree.unions.size() - left);
        std::vector<std::pair<int, int>> groups(patches.size());  // patches, and minus the leading piece
        for (std::size_t p = 0; p < patches.size(); ++p)
            groups[at(lead[p])] = {groups[at(lead[p])].first + patches[p], -lead[p]};
        std::partial_sort(groups.begin(), groups.begin() + 2, groups.end(), std::greater<>());
        if (groups[1].first <= best_count) continue;
        best_count = groups[1].first;
        best.assign(patches.size(), -1);
        for (std::size_t p = 0; p < patches.size(); ++p) {
            if (patches[p] > 0) best[p] = lead[p] == -groups[1].second ? 1 : 0;
        }
    }
    return best_count < fewest_of_half * all ? std::vector<int>() : best;
}

void CorrectionState::split(const Correction& c) {
    require_live(c.part, c.where);
    if (base_.cut.tree.empty())
        refuse(c.where,
               "parts are split by the tree of levels, and the run has none; run coseg run with "
               "--levels, or give a new part faces of its own");
    const std::vector<int> half = halves(c.part);
    if (half.empty())
        refuse(c.where, "part " + std::to_string(c.part) +
                            " does not fall in two at any level; give a new part faces of its own");
    add_part(c.where);
    const int added = part_count() - 1;
    const std::vector<int>& piece = base_.cut.tree.piece_of_patch;
    for (std::size_t i = 0; i < base_parts_.size(); ++i) {
        if (base_parts_[i] == c.part && half[at(piece[i])] == 1) base_parts_[i] = added;
    }
    absent_.row(added) = absent_.row(c.part);
    // What was said of the part is now said of the half in which the face's patch lies.
    for (std::size_t k = 0; k < said_.size(); ++k) {
        if (said_[k].part.empty()) continue;
        const MeshDescription& mesh = base_.collection.local[k];
        const std::vector<int> patch = patch_of_input_face(mesh);
        const int first = base_.collection.numbering.first(mesh.mesh, 0);
        for (std::size_t f = 0; f < patch.size(); ++f) {
            if (said_[k].part[f] == c.part && half[at(piece[at(first + patch[f])])] == 1)
                said_[k].part[f] = added;
        }
    }
}

void CorrectionState::take_level(const Correction& c) {
    const PartTree& tree = base_.cut.tree;
    if (tree.empty()) refuse(c.where, "the run has no levels; run coseg run with --levels");
    if (!is_untouched_)
        refuse(c.where, "a level can only be chosen before anything else is said; undo the rest first");
    if (c.part > tree.finest())
        refuse(c.where, "the finest level has " + std::to_string(tree.finest()) + " parts");
    const std::vector<int> labels = labels_at_level(tree, c.part);
    for (std::size_t i = 0; i < base_parts_.size(); ++i) base_parts_[i] = labels[at(tree.piece_of_patch[i])];
    is_live_.assign(at(c.part), true);
    absent_ = Eigen::MatrixXi::Constant(c.part, absent_.cols(), -1);
    for (std::size_t k = 0; k < base_.examples.size(); ++k) said_[k] = {};
}

std::string named_act(const std::vector<Correction>& acts, int act) {
    if (act < 0) return "an example";
    const Correction& c = acts[at(act)];
    return c.where + " (" + summary_of(c) + ")";
}

}  // namespace coseg
