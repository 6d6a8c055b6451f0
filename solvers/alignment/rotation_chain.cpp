#include "solvers/alignment/rotation_chain.hpp"

#include <algorithm>
#include <cstddef>
#include <queue>
#include <tuple>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// A step from a shape that is reached to one that may not be.
struct Step {
    double agreement = 0.0;
    int from = 0;  ///< reached
    int to = 0;
    std::size_t pair = 0;

    /// Of equal agreement the step with the lower numbers comes first.
    friend bool operator<(const Step& a, const Step& b) {
        return std::tie(a.agreement, b.to, b.from, b.pair) < std::tie(b.agreement, a.to, a.from, a.pair);
    }
};

int root_of(int shapes, const std::vector<PairRotation>& pairs) {
    std::vector<double> sums(at(shapes), 0.0);
    for (const PairRotation& pair : pairs) {
        sums[at(pair.from)] += pair.agreement;
        sums[at(pair.to)] += pair.agreement;
    }
    return static_cast<int>(std::max_element(sums.begin(), sums.end()) - sums.begin());
}

}  // namespace

ChainedRotations chained_rotations(int shapes, const std::vector<PairRotation>& pairs) {
    std::vector<std::vector<std::size_t>> pairs_of(at(shapes));
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        pairs_of[at(pairs[k].from)].push_back(k);
        pairs_of[at(pairs[k].to)].push_back(k);
    }
    ChainedRotations chained{std::vector<Eigen::Matrix3d>(at(shapes), Eigen::Matrix3d::Identity()),
                             std::vector<bool>(at(shapes), false)};
    std::priority_queue<Step> steps;
    const auto reach = [&](int shape) {
        chained.reached[at(shape)] = true;
        for (const std::size_t k : pairs_of[at(shape)])
            steps.push({pairs[k].agreement, shape, pairs[k].from == shape ? pairs[k].to : pairs[k].from, k});
    };
    reach(root_of(shapes, pairs));
    while (!steps.empty()) {
        const Step step = steps.top();
        steps.pop();
        if (chained.reached[at(step.to)]) continue;
        const PairRotation& pair = pairs[step.pair];
        const Eigen::Matrix3d& known = chained.rotations[at(step.from)];
        chained.rotations[at(step.to)] = pair.from == step.to
                                             ? Eigen::Matrix3d(known * pair.rotation)
                                             : Eigen::Matrix3d(known * pair.rotation.transpose());
        reach(step.to);
    }
    return chained;
}

}  // namespace coseg
