#include "src/metrics/segmentation_score.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "src/base/error.hpp"
#include "src/metrics/assignment.hpp"
#include "src/metrics/rand_index.hpp"

namespace coseg {
namespace {

using Cell = std::pair<int, int>;          // cluster, truth label
using AreaTable = std::map<Cell, double>;  // share of a shape's area in each
using Mapping = std::map<int, int>;        // cluster -> truth label; clusters left over are absent

void check_lengths(const LabelledShape& shape) {
    const auto complain = [&](const std::string& what, std::size_t size) {
        throw Error(ExitCode::input, "'" + shape.name + "' has " + std::to_string(shape.truth.size()) +
                                         " truth labels but " + std::to_string(size) + " " + what +
                                         "; score labels against the mesh they were made for.");
    };
    if (shape.labels->size() != shape.truth.size()) complain("labels", shape.labels->size());
    if (shape.face_area.size() != shape.truth.size()) complain("faces", shape.face_area.size());
}

double checked_total_area(const LabelledShape& shape) {
    for (std::size_t face = 0; face < shape.face_area.size(); ++face) {
        const double area = shape.face_area[face];
        if (std::isfinite(area) && area >= 0.0) continue;
        throw Error(ExitCode::input, "face " + std::to_string(face) + " of '" + shape.name +
                                         "' has no finite area; repair its vertices.");
    }
    const double total = std::accumulate(shape.face_area.begin(), shape.face_area.end(), 0.0);
    if (total > 0.0) return total;
    throw Error(ExitCode::input, "'" + shape.name + "' has no area; there is nothing to score.");
}

AreaTable area_table(const LabelledShape& shape) {
    check_lengths(shape);
    const double total = checked_total_area(shape);
    AreaTable table;
    for (std::size_t face = 0; face < shape.truth.size(); ++face) {
        if (shape.truth[face] < 0) continue;
        table[{(*shape.labels)[face], shape.truth[face]}] += shape.face_area[face] / total;
    }
    return table;
}

template <class Projection>
std::vector<int> distinct_sorted(const AreaTable& table, Projection label_of) {
    std::vector<int> labels;
    for (const auto& [cell, area] : table) labels.push_back(label_of(cell));
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    return labels;
}

int position_of(const std::vector<int>& sorted, int label) {
    return static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), label) - sorted.begin());
}

/// The collection's cluster x truth label table: what each pairing gains, summed over shapes.
struct GainTable {
    std::vector<int> clusters;
    std::vector<int> truth_labels;
    Eigen::MatrixXd gain;
};

GainTable gain_table(const std::vector<AreaTable>& tables) {
    AreaTable sum;
    for (const AreaTable& table : tables) {
        for (const auto& [cell, area] : table) sum[cell] += area;
    }
    GainTable result;
    result.clusters = distinct_sorted(sum, [](const Cell& cell) { return cell.first; });
    result.truth_labels = distinct_sorted(sum, [](const Cell& cell) { return cell.second; });
    result.gain = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(result.clusters.size()),
                                        static_cast<Eigen::Index>(result.truth_labels.size()));
    for (const auto& [cell, area] : sum) {
        result.gain(position_of(result.clusters, cell.first), position_of(result.truth_labels, cell.second)) =
            area;
    }
    return result;
}

Mapping one_to_one_mapping(const GainTable& table) {
    const std::vector<int> column_of = best_assignment(table.gain);
    Mapping mapping;
    for (std::size_t row = 0; row < column_of.size(); ++row) {
        if (column_of[row] >= 0) mapping[table.clusters[row]] = table.truth_labels[column_of[row]];
    }
    return mapping;
}

Mapping many_to_one_mapping(const GainTable& table) {
    Mapping mapping;
    for (int row = 0; row < table.gain.rows(); ++row) {
        Eigen::Index column = 0;
        table.gain.row(row).maxCoeff(&column);
        mapping[table.clusters[row]] = table.truth_labels[column];
    }
    return mapping;
}

/// The shares of a shape sum to 1 but for rounding, which nobody should take for more than all.
double at_most_all(double share) { return std::min(share, 1.0); }

double accuracy(const AreaTable& table, const Mapping& mapping) {
    double right = 0.0;
    for (const auto& [cell, area] : table) {
        const auto mapped = mapping.find(cell.first);
        if (mapped != mapping.end() && mapped->second == cell.second) right += area;
    }
    return at_most_all(right);
}

/// The truth label that covers most of the collection, each shape weighing the same. The table must not be
/// empty.
int largest_truth_label(const GainTable& table) {
    Eigen::Index column = 0;
    table.gain.colwise().sum().maxCoeff(&column);
    return table.truth_labels[column];
}

double area_of_truth_label(const AreaTable& table, int truth_label) {
    double sum = 0.0;
    for (const auto& [cell, area] : table) sum += cell.second == truth_label ? area : 0.0;
    return at_most_all(sum);
}

void set_means(SegmentationScore& score) {
    const auto mean_of = [&](double ShapeScore::*figure) {
        double sum = 0.0;
        for (const ShapeScore& shape : score.shapes) sum += shape.*figure;
        return score.shapes.empty() ? 0.0 : sum / static_cast<double>(score.shapes.size());
    };
    score.one_to_one = mean_of(&ShapeScore::one_to_one);
    score.many_to_one = mean_of(&ShapeScore::many_to_one);
    score.one_label = mean_of(&ShapeScore::one_label);
    score.rand_index = mean_of(&ShapeScore::rand_index);
    score.face_rand_index = mean_of(&ShapeScore::face_rand_index);
}

}  // namespace

SegmentationScore score_segmentation(const std::vector<LabelledShape>& shapes) {
    std::vector<AreaTable> tables;
    tables.reserve(shapes.size());
    for (const LabelledShape& shape : shapes) {
        tables.push_back(shape.labels ? area_table(shape) : AreaTable{});
    }
    const GainTable gains = gain_table(tables);
    const Mapping one_to_one = one_to_one_mapping(gains);
    const Mapping many_to_one = many_to_one_mapping(gains);

    SegmentationScore score;
    score.clusters = static_cast<int>(gains.clusters.size());
    score.truth_labels = static_cast<int>(gains.truth_labels.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        ShapeScore one{.name = shapes[i].name, .missing = !shapes[i].labels};
        if (!one.missing && score.clusters > 0) {
            one.one_to_one = accuracy(tables[i], one_to_one);
            one.many_to_one = accuracy(tables[i], many_to_one);
            one.one_label = area_of_truth_label(tables[i], largest_truth_label(gains));
            one.rand_index = rand_index(shapes[i].truth, *shapes[i].labels, shapes[i].face_area);
            one.face_rand_index = rand_index(shapes[i].truth, *shapes[i].labels);
        }
        score.shapes.push_back(one);
    }
    set_means(score);
    return score;
}

double upper_bound_of_labels(const LabelledShape& shape) {
    if (!shape.labels) return 0.0;
    std::map<int, double> most;
    for (const auto& [cell, area] : area_table(shape)) {
        double& best = most[cell.first];
        best = std::max(best, area);
    }
    double right = 0.0;
    for (const auto& [label, area] : most) right += area;
    return at_most_all(right);
}

}  // namespace coseg
