#include "solvers/partition/open_questions.hpp"

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// The part of its mesh's area that makes a mesh count as one that follows.
constexpr double follower_share = 0.01;

}  // namespace

std::vector<OpenQuestion> open_questions(const PartitionObjective& objective,
                                         const std::vector<double>& confidence,
                                         const std::vector<bool>& is_closed) {
    const std::vector<int>& mesh_of = objective.mesh_of;
    std::vector<OpenQuestion> questions(at(objective.meshes));
    std::vector<double> value(mesh_of.size(), 0.0);
    const auto doubt = [&](int i) { return 1.0 - confidence[at(i)]; };
    for (int i = 0; i < static_cast<int>(mesh_of.size()); ++i) {
        value[at(i)] = objective.share[at(i)] * doubt(i);
        questions[at(mesh_of[at(i)])].own += value[at(i)];
    }
    std::vector<double> leaning(questions.size(), 0.0);  // of one mesh on each other one
    std::vector<int> touched;
    const auto flush = [&] {
        for (const int m : touched) {
            if (leaning[at(m)] >= follower_share) ++questions[at(m)].followers;
            leaning[at(m)] = 0.0;
        }
        touched.clear();
    };
    for (int j = 0; j < static_cast<int>(mesh_of.size()); ++j) {
        const int mesh = mesh_of[at(j)];
        if (j > 0 && mesh_of[at(j - 1)] != mesh) flush();
        const double at_stake = objective.share[at(j)] * doubt(j);
        if (is_closed[at(mesh)] || at_stake <= 0.0) continue;
        double all = 0.0;
        for_each_tie(objective, j, [&](int i, double gain) { all += mesh_of[at(i)] != mesh ? gain : 0.0; });
        if (all <= 0.0) continue;
        for_each_tie(objective, j, [&](int i, double gain) {
            const int other = mesh_of[at(i)];
            if (other == mesh || is_closed[at(other)]) return;
            const double brought = at_stake * gain / all * doubt(i);
            questions[at(other)].others += brought;
            value[at(i)] += brought;
            if (leaning[at(other)] == 0.0) touched.push_back(other);
            leaning[at(other)] += brought;
        });
    }
    flush();
    for (int i = 0; i < static_cast<int>(mesh_of.size()); ++i) {
        OpenQuestion& question = questions[at(mesh_of[at(i)])];
        if (question.patch < 0 || value[at(i)] > value[at(question.patch)]) question.patch = i;
    }
    for (std::size_t m = 0; m < questions.size(); ++m) {
        if (is_closed[m]) questions[m] = {};
    }
    return questions;
}

int next_question(const std::vector<OpenQuestion>& questions, const std::vector<bool>& is_closed) {
    int best = -1;
    for (int m = 0; m < static_cast<int>(questions.size()); ++m) {
        if (is_closed[at(m)]) continue;
        if (best < 0 || questions[at(m)].value() > questions[at(best)].value()) best = m;
    }
    return best;
}

}  // namespace coseg
