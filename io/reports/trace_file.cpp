#include "io/reports/trace_file.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/files/atomic_file.hpp"

namespace coseg {

namespace {

using Json = nlohmann::ordered_json;

constexpr double microseconds = 1e6;

Json process_name(std::size_t rank) {
    return {{"name", "process_name"},
            {"ph", "M"},
            {"pid", rank},
            {"tid", 0},
            {"args", {{"name", "rank " + std::to_string(rank)}}}};
}

Json complete_event(const TraceEvent& event, std::size_t rank) {
    return {{"name", event.name},
            {"cat", event.category},
            {"ph", "X"},
            {"ts", event.start * microseconds},
            {"dur", event.seconds * microseconds},
            {"pid", rank},
            {"tid", 0}};
}

RankTrace enclosing_first(RankTrace events) {
    std::stable_sort(events.begin(), events.end(), [](const TraceEvent& a, const TraceEvent& b) {
        return a.start != b.start ? a.start < b.start : a.seconds > b.seconds;
    });
    return events;
}

}  // namespace

void write_trace(const std::string& path, const std::vector<RankTrace>& ranks) {
    Json events = Json::array();
    for (std::size_t rank = 0; rank < ranks.size(); ++rank) {
        events.push_back(process_name(rank));
        for (const TraceEvent& event : enclosing_first(ranks[rank]))
            events.push_back(complete_event(event, rank));
    }
    const Json trace = {{"displayTimeUnit", "ms"}, {"traceEvents", std::move(events)}};
    // A mesh's name is a file's name, which need not be UTF-8.
    write_file(path, trace.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace coseg
