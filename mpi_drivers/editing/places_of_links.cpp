#include "mpi_drivers/editing/places_of_links.hpp"

#include <algorithm>

#include "io/data_files/correction_file.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

void say_faces(const MeshDescription& mesh, const CorrectedPlace& place, int part, std::vector<int>& faces) {
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

}  // namespace

PlacesOfLinks::PlacesOfLinks(const CorrectionState& state) {
    for (const Correction& link : state.links()) {
        const bool same = link.kind == CorrectionKind::must_link;
        links_.push_back({number_of(state, link.first), number_of(state, link.second), same,
                          link.where + " (" + summary_of(link) + ")"});
    }
}

int PlacesOfLinks::number_of(const CorrectionState& state, const CorrectedPlace& place) {
    for (std::size_t p = 0; p < place_.size(); ++p) {
        if (place_[p] == place) return static_cast<int>(p);
    }
    place_.push_back(place);
    mesh_.push_back(state.mesh_of(place.shape, "a link"));
    return static_cast<int>(place_.size()) - 1;
}

void PlacesOfLinks::add_local(const CorrectionBase& base, const CorrectionState& state, std::size_t k,
                              std::vector<PlaceFacts>& local) const {
    const MeshDescription& mesh = base.collection.local[k];
    if (std::find(mesh_.begin(), mesh_.end(), mesh.mesh) == mesh_.end()) return;
    const std::vector<int> patch = patch_of_input_face(mesh);
    const int first = base.collection.numbering.first(mesh.mesh, 0);
    const SaidFaces& said = state.said()[k];
    for (std::size_t p = 0; p < place_.size(); ++p) {
        if (mesh_[p] != mesh.mesh) continue;
        const CorrectedPlace& place = place_[p];
        PlaceFacts fact{static_cast<int>(p), first + (place.face >= 0 ? patch[at(place.face)] : place.patch),
                        -1, -1};
        for (std::size_t f = 0; f < said.part.size(); ++f) {
            const bool is_in = place.face >= 0 ? static_cast<int>(f) == place.face : patch[f] == place.patch;
            if (!is_in || said.part[f] < 0 || fact.said >= 0) continue;
            fact.said = said.part[f];
            fact.act = said.act[f];
        }
        local.push_back(fact);
    }
}

void PlacesOfLinks::find(const Comm& comm, const CorrectionBase& base, const CorrectionState& state) {
    std::vector<PlaceFacts> local;
    agree(comm, [&] {
        for (std::size_t k = 0; k < state.said().size(); ++k) add_local(base, state, k, local);
    });
    facts_ = all_gather_records(comm, local);
    std::sort(facts_.begin(), facts_.end(),
              [](const PlaceFacts& a, const PlaceFacts& b) { return a.place < b.place; });
}

std::vector<LinkedPlace> PlacesOfLinks::with_scores(const Eigen::MatrixXd& scores,
                                                    const std::vector<Correction>& acts) const {
    std::vector<LinkedPlace> places;
    for (const PlaceFacts& fact : facts_)
        places.push_back(
            {mesh_[at(fact.place)], fact.said, named_act(acts, fact.act), scores.col(fact.patch)});
    return places;
}

void PlacesOfLinks::say(const CorrectionBase& base, const std::vector<int>& parts,
                        const std::vector<double>& patch_area, Eigen::MatrixXd& said_area,
                        std::vector<std::vector<int>>& faces) const {
    for (const PlaceFacts& fact : facts_)
        said_area(parts[at(fact.place)], fact.patch) += patch_area[at(fact.patch)];
    for (const bool patches : {true, false}) {
        for (std::size_t k = 0; k < base.collection.local.size(); ++k) {
            for (const PlaceFacts& fact : facts_) {
                const CorrectedPlace& place = place_[at(fact.place)];
                if (mesh_[at(fact.place)] != base.collection.local[k].mesh || (place.face < 0) != patches)
                    continue;
                say_faces(base.collection.local[k], place, parts[at(fact.place)], faces[k]);
            }
        }
    }
}

}  // namespace coseg
