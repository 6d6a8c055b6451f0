#pragma once
// The times that the stages of a run took.

#include <string>
#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

struct StepTime {
    std::string step;
    double seconds = 0.0;      ///< sum over ranks
    double seconds_min = 0.0;  ///< of the rank that spent least on it
    double seconds_max = 0.0;
    static constexpr auto fields() {
        return std::tuple(field("step", &StepTime::step), field("seconds", &StepTime::seconds),
                          field("seconds_min", &StepTime::seconds_min),
                          field("seconds_max", &StepTime::seconds_max));
    }
};

struct StageTimes {
    std::string stage;
    double seconds_min = 0.0;  ///< the shortest time that any rank worked on the stage, without waiting
    double seconds_mean = 0.0;
    double seconds_max = 0.0;
    double seconds_wall = 0.0;    ///< from the first line of the stage to its agreed end, with waiting
    std::vector<StepTime> steps;  ///< the steps of the stage, if it names any
    static constexpr auto fields() {
        return std::tuple(
            field("stage", &StageTimes::stage), field("seconds_min", &StageTimes::seconds_min),
            field("seconds_mean", &StageTimes::seconds_mean), field("seconds_max", &StageTimes::seconds_max),
            field("seconds_wall", &StageTimes::seconds_wall), field("steps", &StageTimes::steps));
    }
};

}  // namespace coseg
