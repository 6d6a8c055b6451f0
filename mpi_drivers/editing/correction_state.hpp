#pragma once
// What the acts of a person come to in one collection: which parts there are, what is said of faces, which
// shapes have nothing of a part, and which places are linked.

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "src/records/correction.hpp"
#include "src/records/cut_result.hpp"

namespace coseg {

/// What the acts are about: a collection and its partition before anything is said.
struct CorrectionBase {
    const Collection& collection;
    const CutResult& cut;
    int parts = 0;  ///< K of the cut
    /// GivenLabels::faces, what examples say of the faces of the local meshes; empty without examples.
    const std::vector<std::vector<int>>& examples;
    const std::map<int, std::string>& names;  ///< that parts have already; on rank 0
};

/// A hash of what acts refer to: the names and numbers of faces of the meshes, and the part of every patch.
/// The same on any number of ranks. Acts about one base mean nothing in another one.
std::string base_hash(const CorrectionBase& base);

/// What is said of the faces of a mesh of this rank.
struct SaidFaces {
    std::vector<int> part;  ///< of each face of the file, -1 where nothing is said; empty: nothing at all
    std::vector<int> act;   ///< which act has said it, counted from 0; -1: an example
};

/// Numbers of parts are never used again: a part that was merged into another leaves its number empty.
class CorrectionState {
  public:
    explicit CorrectionState(const CorrectionBase& base);

    /// Throws Error(input) where the act cannot be meant: no such shape, face, patch, part or level, or a
    /// part that cannot be split. Which ranks throw may differ: call it in agree. The state is then as it was
    /// before or useless. `act` is its number.
    void apply(const Correction& correction, int act);

    [[nodiscard]] int part_count() const noexcept { return static_cast<int>(is_live_.size()); }
    [[nodiscard]] bool is_live(int part) const { return is_live_.at(static_cast<std::size_t>(part)); }
    /// Of all patches.
    [[nodiscard]] const std::vector<int>& base_parts() const noexcept { return base_parts_; }
    /// Of each mesh of collection.local.
    [[nodiscard]] const std::vector<SaidFaces>& said() const noexcept { return said_; }
    /// Whether something is said that parts of patches follow: labels, links or absent parts.
    [[nodiscard]] bool says_something() const noexcept { return says_something_; }
    /// K x M: the number of the act that says that the mesh has nothing of the part, or -1.
    [[nodiscard]] const Eigen::MatrixXi& absent() const noexcept { return absent_; }
    [[nodiscard]] const std::vector<Correction>& links() const noexcept { return links_; }
    [[nodiscard]] const std::vector<bool>& confirmed() const noexcept { return confirmed_; }
    /// On rank 0 with those that parts had before.
    [[nodiscard]] const std::map<int, std::string>& names() const noexcept { return names_; }
    [[nodiscard]] const std::map<int, std::string>& colors() const noexcept { return colors_; }
    /// The number of the shape. Throws Error(input) where there is none of this name.
    [[nodiscard]] int mesh_of(const std::string& shape, const std::string& where) const;
    /// Whether the part can be split: the cut has a tree in which it falls in two.
    [[nodiscard]] bool can_split(int part) const { return !halves(part).empty(); }

  private:
    void say(const Correction& correction, int act);
    void confirm(const Correction& correction, int act);
    void merge(const Correction& correction);
    void split(const Correction& correction);
    void take_level(const Correction& correction);
    void add_part(const std::string& where);
    void require_live(int part, const std::string& where) const;
    void check_place(const CorrectedPlace& place, const std::string& where) const;
    [[nodiscard]] std::vector<int> halves(int part) const;
    SaidFaces* said_of(int mesh);

    CorrectionBase base_;
    std::map<std::string, int> mesh_of_name_;
    std::vector<bool> is_live_;
    std::vector<int> base_parts_;
    std::vector<SaidFaces> said_;
    Eigen::MatrixXi absent_;
    std::vector<Correction> links_;
    std::vector<bool> confirmed_;
    std::map<int, std::string> names_;
    std::map<int, std::string> colors_;
    bool says_something_ = false;
    bool is_untouched_ = true;  ///< nothing but a level was said
};

/// The patch of the first over-segmentation of each face of the file, as patches/NAME.seg has it.
std::vector<int> patch_of_input_face(const MeshDescription& mesh);

/// What messages call an act: where it stands and what it says; an example where `act` is -1.
std::string named_act(const std::vector<Correction>& acts, int act);

}  // namespace coseg
