#include "src/measures/piece_numbers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>

#include "src/base/index.hpp"
#include "src/metrics/assignment.hpp"

namespace coseg {

namespace {

using Places = std::vector<Eigen::Vector3d>;

auto coordinates_of(const Eigen::Vector3d& p) { return std::array<double, 3>{p.x(), p.y(), p.z()}; }

/// The column of each row in the assignment of least squared distances; -1 for a row left over.
std::vector<int> nearest_assignment(const Places& rows, const Places& columns) {
    Eigen::MatrixXd gain(std::ssize(rows), std::ssize(columns));
    for (Eigen::Index r = 0; r < gain.rows(); ++r) {
        for (Eigen::Index c = 0; c < gain.cols(); ++c)
            gain(r, c) = -(rows[at(r)] - columns[at(c)]).squaredNorm();
    }
    return best_assignment(gain);
}

/// Numbers the pieces of one part in all shapes.
class PartNumbering {
  public:
    /// `members`: numbers of pieces.
    PartNumbering(const std::vector<PartPiece>& pieces, const std::vector<int>& members,
                  std::vector<int>& numbers)
        : pieces_(pieces), numbers_(numbers) {
        for (const int k : members) by_shape_[pieces[at(k)].shape].push_back(k);
        for (auto& [shape, list] : by_shape_) {
            std::sort(list.begin(), list.end(), [&](int a, int b) { return rank_of(a) < rank_of(b); });
        }
    }

    void run() {
        constexpr int most_places = 100;
        const int places = common_count();
        const Places mean = places <= most_places ? mean_places(places) : Places{};
        for (const auto& [shape, list] : by_shape_) number(list, mean);
    }

  private:
    /// Large pieces first.
    [[nodiscard]] std::pair<double, std::array<double, 3>> rank_of(int piece) const {
        return {-pieces_[at(piece)].share, coordinates_of(pieces_[at(piece)].place)};
    }

    /// How many of a shape's pieces count, which are the first ones of its list.
    [[nodiscard]] int counted(const std::vector<int>& list) const {
        constexpr double least = 0.1;
        const double largest = pieces_[at(list.front())].share;
        return static_cast<int>(std::count_if(
            list.begin(), list.end(), [&](int k) { return pieces_[at(k)].share >= least * largest; }));
    }

    [[nodiscard]] Places places_of(const std::vector<int>& list) const {
        Places places;
        for (int k = 0; k < counted(list); ++k) places.push_back(pieces_[at(list[at(k)])].place);
        return places;
    }

    /// The number of pieces above 1 that most shapes have, of several the largest; 1 if few have it.
    [[nodiscard]] int common_count() const {
        constexpr std::size_t least = 4;  // one of so many shapes
        std::map<int, std::size_t> shapes;
        for (const auto& [shape, list] : by_shape_) ++shapes[counted(list)];
        int best = 1;
        for (const auto& [count, of] : shapes) {
            if (count > 1 && (best == 1 || of >= shapes[best])) best = count;
        }
        return least * shapes[best] >= by_shape_.size() ? best : 1;
    }

    [[nodiscard]] Places mean_places(int count) const {
        constexpr int most_rounds = 20;
        std::vector<Places> shapes;
        for (const auto& [shape, list] : by_shape_) {
            if (counted(list) == count) shapes.push_back(places_of(list));
        }
        Places mean = shapes.front();
        for (int round = 0; round < most_rounds; ++round) {
            Places sums(at(count), Eigen::Vector3d::Zero());
            for (const Places& places : shapes) {
                const std::vector<int> nearest = nearest_assignment(places, mean);
                for (std::size_t k = 0; k < places.size(); ++k) sums[at(nearest[k])] += places[k];
            }
            for (Eigen::Vector3d& sum : sums) sum /= static_cast<double>(shapes.size());
            if (sums == mean) break;
            mean = sums;
        }
        std::sort(mean.begin(), mean.end(), [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
            return coordinates_of(a) < coordinates_of(b);
        });
        return mean;
    }

    void number(const std::vector<int>& list, const Places& mean) {
        int next = static_cast<int>(mean.size()) + 1;
        std::vector<int> nearest(list.size(), -1);
        if (!mean.empty() && counted(list) == 1) {
            nearest.front() = 0;
        } else if (!mean.empty()) {
            const std::vector<int> found = nearest_assignment(places_of(list), mean);
            std::copy(found.begin(), found.end(), nearest.begin());
        }
        for (std::size_t k = 0; k < list.size(); ++k)
            numbers_[at(list[k])] = nearest[k] >= 0 ? nearest[k] + 1 : next++;
    }

    const std::vector<PartPiece>& pieces_;
    std::vector<int>& numbers_;
    std::map<int, std::vector<int>> by_shape_;
};

}  // namespace

std::vector<PartPiece> pieces_of_shape(int shape, const TriMesh& mesh, const std::vector<int>& part_of_face,
                                       const std::vector<int>& piece_of_face) {
    const Eigen::Vector3d low = mesh.vertices.rowwise().minCoeff();
    const Eigen::Vector3d high = mesh.vertices.rowwise().maxCoeff();
    const int count =
        piece_of_face.empty() ? 0 : *std::max_element(piece_of_face.begin(), piece_of_face.end()) + 1;
    std::vector<PartPiece> pieces(at(count));
    double total = 0.0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Eigen::Vector3d a = mesh.vertices.col(mesh.faces(0, f));
        const Eigen::Vector3d b = mesh.vertices.col(mesh.faces(1, f));
        const Eigen::Vector3d c = mesh.vertices.col(mesh.faces(2, f));
        const double area = 0.5 * (b - a).cross(c - a).norm();
        PartPiece& piece = pieces[at(piece_of_face[at(f)])];
        piece.part = part_of_face[at(f)];
        piece.share += area;
        piece.place += area / 3.0 * (a + b + c);
        total += area;
    }
    const double diagonal = (high - low).norm();
    for (PartPiece& piece : pieces) {
        piece.shape = shape;
        if (piece.share > 0.0) piece.place = (piece.place / piece.share - 0.5 * (low + high)) / diagonal;
        piece.share /= total;
    }
    return pieces;
}

std::vector<int> piece_numbers(const std::vector<PartPiece>& pieces) {
    std::map<int, std::vector<int>> by_part;
    for (std::size_t k = 0; k < pieces.size(); ++k) by_part[pieces[k].part].push_back(static_cast<int>(k));
    std::vector<int> numbers(pieces.size(), 0);
    for (const auto& [part, members] : by_part) PartNumbering(pieces, members, numbers).run();
    return numbers;
}

}  // namespace coseg
