#include "io/reports/report.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "io/files/atomic_file.hpp"

namespace coseg {

namespace {

using Json = nlohmann::ordered_json;

/// An option's text as the number, truth value or text that it is.
Json typed(const std::string& text) {
    if (Json::accept(text)) {
        Json value = Json::parse(text);
        if (value.is_number() || value.is_boolean()) return value;
    }
    return text;
}

Json of_stages(const std::vector<ReportStage>& stages) {
    Json rows = Json::array();
    for (const ReportStage& s : stages) {
        Json row = {{"stage", s.stage},
                    {"seconds_min", s.seconds_min},
                    {"seconds_mean", s.seconds_mean},
                    {"seconds_max", s.seconds_max},
                    {"seconds_wall", s.seconds_wall}};
        for (const ReportStep& step : s.steps)
            row["steps"].push_back({{"step", step.step}, {"seconds", step.seconds}});
        rows.push_back(std::move(row));
    }
    return rows;
}

Json of_state(const ReportState& state) {
    return {{"folder", state.folder},
            {"meshes_reused", state.meshes_reused},
            {"meshes_described", state.meshes_described},
            {"tiles_reused", state.tiles_reused},
            {"tiles_solved", state.tiles_solved},
            {"cuts_reused", state.cuts_reused}};
}

Json of_meshes(const std::vector<ReportMesh>& meshes) {
    Json rows = Json::array();
    for (const ReportMesh& m : meshes) {
        rows.push_back({{"name", m.name},
                        {"path", m.path},
                        {"faces", m.faces},
                        {"working_faces", m.working_faces},
                        {"remeshed", m.remeshed},
                        {"overlong_area", m.overlong_area},
                        {"patches", m.patches},
                        {"rank", m.rank},
                        {"seconds", m.seconds},
                        {"part_area", m.part_area},
                        {"warnings", m.warnings}});
    }
    return rows;
}

Json of_history(const std::vector<ReportPass>& history) {
    Json rows = Json::array();
    for (const ReportPass& p : history) {
        rows.push_back({{"pass", p.pass},
                        {"iterations", p.iterations},
                        {"objective", p.objective},
                        {"lower_bound", p.lower_bound},
                        {"relative_gap", p.relative_gap},
                        {"working_pairs", p.working_pairs}});
    }
    return rows;
}

Json of_optimisation(const ReportOptimisation& o) {
    return {{"variant", o.variant},
            {"scope", o.scope},
            {"links", o.links},
            {"subsets", o.subsets},
            {"common_meshes", o.common_meshes},
            {"subset_agreement", o.subset_agreement},
            {"allowed_pairs", o.allowed_pairs},
            {"patches", o.patches},
            {"objective", o.objective},
            {"objective_at_zero", o.objective_at_zero},
            {"lower_bound", o.lower_bound},
            {"relative_gap", o.relative_gap},
            {"kkt_residual", o.kkt_residual},
            {"iterations", o.iterations},
            {"nonzero_groups", o.nonzero_groups},
            {"reason", o.reason},
            {"history", of_history(o.history)}};
}

Json of_partition(const Report& report) {
    Json starts = Json::array();
    for (const ReportStart& s : report.starts) {
        starts.push_back({{"adjacency", s.adjacency},
                          {"placed", s.placed},
                          {"clusters", s.clusters},
                          {"merging", s.merging},
                          {"score", s.score},
                          {"concavity", s.concavity},
                          {"presence", s.presence},
                          {"link_consistency", s.link_consistency},
                          {"explained_common", s.explained_common},
                          {"explained_own", s.explained_own}});
    }
    return {{"eigenvalues", report.eigenvalues},
            {"starts", starts},
            {"chosen_start", report.chosen_start},
            {"places",
             {{"directions", report.position_directions}, {"correlations", report.position_correlations}}},
            {"part_area", report.part_area},
            {"affinity", {{"rows", report.affinity_rows}, {"part_ends", report.affinity_part_ends}}}};
}

Json of_features(const Report& report) {
    Json ranges = Json::array();
    for (const ReportRange& r : report.ranges) {
        ranges.push_back({{"feature", r.feature}, {"kind", r.kind}, {"low", r.low}, {"high", r.high}});
    }
    Json strengths = Json::array();
    for (const ReportStrength& s : report.feature_strengths) {
        strengths.push_back({{"feature", s.feature}, {"overall", s.overall}, {"within_part", s.within_part}});
    }
    return {{"ranges", ranges},
            {"strengths", strengths},
            {"pairs_by_feature_count", report.pairs_by_feature_count},
            {"inside_part", report.inside_part},
            {"coefficient_blocks", report.coefficient_blocks}};
}

}  // namespace

std::string history_json(const std::vector<ReportPass>& history) { return of_history(history).dump(); }

void write_report(const std::string& path, const Report& report) {
    Json root;
    root["format"] = "coseg report 1";
    for (const auto& [name, version] : report.versions) root["versions"][name] = version;
    for (const auto& [key, value] : report.options) root["options"][key] = typed(value);
    root["ranks"] = report.ranks;
    root["seconds"] = report.seconds;
    root["peak_memory_sum_mib"] = report.peak_memory_sum_mib;
    root["peak_memory_max_mib"] = report.peak_memory_max_mib;
    root["stages"] = of_stages(report.stages);
    root["optimisation"] = of_optimisation(report.optimisation);
    root["partition"] = of_partition(report);
    root["features"] = of_features(report);
    if (!report.state.folder.empty()) root["state"] = of_state(report.state);
    root["meshes"] = of_meshes(report.meshes);
    root["set_aside"] = Json::array();
    for (const auto& [mesh, reason] : report.set_aside)
        root["set_aside"].push_back({{"path", mesh}, {"reason", reason}});
    write_file(path, root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace coseg
