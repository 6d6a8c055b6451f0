#pragma once
// The places that must-link and cannot-link acts name: which patch each is of, and what is said of it.

#include <Eigen/Core>
#include <string>
#include <tuple>
#include <vector>

#include "mpi_drivers/editing/correction_state.hpp"
#include "mpi_drivers/editing/linked_places.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/correction.hpp"
#include "src/records/fields.hpp"

namespace coseg {

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

/// Each place of all links once. The same on all ranks.
class PlacesOfLinks {
  public:
    explicit PlacesOfLinks(const CorrectionState& state);

    [[nodiscard]] const std::vector<PlaceLink>& links() const { return links_; }

    /// Fills in what the ranks know. Collective.
    void find(const Comm& comm, const CorrectionBase& base, const CorrectionState& state);

    /// scores: of each part, for all patches. find() must have been called.
    [[nodiscard]] std::vector<LinkedPlace> with_scores(const Eigen::MatrixXd& scores,
                                                       const std::vector<Correction>& acts) const;

    /// Adds the parts of all places to what is said of patches (said_area: parts x patches) and of the faces
    /// of this rank's meshes; patches first, so that a face inside of one keeps its own.
    void say(const CorrectionBase& base, const std::vector<int>& parts, const std::vector<double>& patch_area,
             Eigen::MatrixXd& said_area, std::vector<std::vector<int>>& faces) const;

  private:
    int number_of(const CorrectionState& state, const CorrectedPlace& place);
    void add_local(const CorrectionBase& base, const CorrectionState& state, std::size_t k,
                   std::vector<PlaceFacts>& local) const;

    std::vector<CorrectedPlace> place_;
    std::vector<int> mesh_;
    std::vector<PlaceLink> links_;
    std::vector<PlaceFacts> facts_;
};

}  // namespace coseg
