#include "mpi_drivers/editing/edit_desk.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "io/reports/edit_page.hpp"
#include "io/reports/json_tree.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"
#include "src/mesh/vertex_clustering.hpp"
#include "src/parallel/record_exchange.hpp"
#include "src/pictures/picture_mesh.hpp"

namespace coseg {

namespace {

/// Triangles of a shape that the page draws.
constexpr int shown_faces = 40'000;
/// How often ranks that wait look whether there is something to do.
constexpr std::chrono::milliseconds look_interval{1};

int required_number(const std::string& word, const std::string& what) {
    const std::optional<int> number = whole_number(word);
    if (!number) throw Error(ExitCode::usage, what + " must be a number, not '" + word + "'");
    return *number;
}

std::vector<std::string> words_of(const std::string& path) {
    std::vector<std::string> words;
    for (std::size_t begin = 1; begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        words.push_back(path.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

HttpReply refusal(int status, const std::string& sentence) {
    JsonTree tree;
    tree.root().member("error").set(sentence);
    return {status, "application/json", tree.line()};
}

/// Waits until rank 0 has come here too, without keeping a core busy. Collective.
void wait_for_root(const Comm& comm) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(comm.raw(), &request);
    for (int done = 0; done == 0;) {
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done == 0) std::this_thread::sleep_for(look_interval);
    }
}

}  // namespace

EditDesk::EditDesk(const Comm& comm, const CorrectionBase& base, EditSession& session, EditPage page)
    : comm_(comm), base_(base), session_(session), page_(std::move(page)) {}

void EditDesk::serve(LocalServer* server) {
    if (comm_.is_root()) {
        server->serve([&](const HttpRequest& request) -> HttpReply {
            if (request.path == "/" || request.path.empty()) return {200, "text/html", page_.html};
            Order order{request.method, request.path, request.query, request.body,
                        request.method == "POST" && request.path == "/end"};
            wait_for_root(comm_);
            broadcast(comm_, order);
            if (order.ends) server->end();
            return carried_out(order);
        });
        return;
    }
    for (Order order; !order.ends;) {
        wait_for_root(comm_);
        broadcast(comm_, order);
        carried_out(order);
    }
}

int EditDesk::mesh_number(const std::string& word) const {
    const std::optional<int> number = whole_number(word);
    if (!number || *number < 0 || *number >= static_cast<int>(base_.collection.meshes.size()))
        throw AgreedError(ExitCode::usage, "there is no shape " + word);
    return *number;
}

/// Collective. What fails is said in the reply, and the session goes on.
HttpReply EditDesk::carried_out(const Order& order) {
    const std::vector<std::string> words = words_of(order.path);
    try {
        if (order.ends) return {200, "application/json", "{}"};
        if (order.method == "POST") return changed_by(order);
        if (words.size() == 1 && words[0] == "state") return {200, "application/json", state_text()};
        if (words.size() == 1 && words[0] == "next") return {200, "application/json", question_text()};
        if (words.size() == 2 && words[0] == "labels")
            return {200, "application/json", labels_text(mesh_number(words[1]))};
        if (words.size() == 2 && words[0] == "mesh")
            return {200, "text/plain", mesh_text(mesh_number(words[1]))};
        return refusal(404, "nothing is at " + order.path);
    } catch (const AgreedError& error) {
        return refusal(error.code() == ExitCode::output ? 507 : 422, error.what());
    }
}

/// Collective.
HttpReply EditDesk::changed_by(const Order& order) {
    const std::vector<std::string> words = words_of(order.path);
    if (words[0] == "save" && words.size() == 1) {
        session_.write_all_labels(page_.folder + "/corrected");
        JsonTree tree;
        tree.root().member("folder").set(page_.folder + "/corrected");
        return {200, "application/json", tree.line()};
    }
    const std::string word = query_value(order.query, "revision");
    const std::optional<int> revision = whole_number(word);
    if (!revision) throw AgreedError(ExitCode::usage, "revision must be a number, not '" + word + "'");
    if (revision != session_.revision())
        return refusal(409,
                       "something was done in another page meanwhile; this one now shows it, so please look "
                       "again");
    const auto start = std::chrono::steady_clock::now();
    do_act(order, words);
    act_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return {200, "application/json", state_text()};
}

/// Collective.
void EditDesk::do_act(const Order& order, const std::vector<std::string>& words) {
    if (words[0] == "undo" && words.size() == 1) return session_.undo();
    if (words[0] == "redo" && words.size() == 1) return session_.redo();
    if (words[0] == "confirm" && words.size() == 2)
        return session_.act(session_.confirmation_of(mesh_number(words[1])));
    if (words[0] == "label" && words.size() == 2) {
        int face = 0;
        int part = 0;
        std::optional<FaceRegion> region;
        agree(comm_, [&] {
            face = required_number(query_value(order.query, "face"), "face");
            part = required_number(query_value(order.query, "part"), "part");
            region = named<FaceRegion>(query_value(order.query, "region"));
            if (!region) throw Error(ExitCode::usage, "region must be face, patch or piece");
        });
        return session_.act(session_.label_of_region(mesh_number(words[1]), face, *region, part));
    }
    if (words[0] != "act" || words.size() != 1)
        throw AgreedError(ExitCode::usage, "nothing can be done at " + order.path);
    Correction correction;
    agree(comm_, [&] { correction = parsed_correction(order.body, "the act"); });
    session_.act(std::move(correction));
}

/// What a page shows beside the shapes.
std::string EditDesk::state_text() {
    const CorrectionState& state = session_.state();
    JsonTree tree;
    const JsonPlace root = tree.root();
    root.member("revision").set(std::int64_t{session_.revision()});
    root.member("seconds").set(act_seconds_);
    root.member("acts").set(static_cast<std::int64_t>(session_.acts().size()));
    root.member("undone").set(static_cast<std::int64_t>(session_.undone().size()));
    root.member("last").set(session_.acts().empty() ? std::string() : summary_of(session_.acts().back()));
    root.member("levels").set(
        static_cast<std::int64_t>(base_.cut.tree.empty() ? 0 : base_.cut.tree.finest()));
    root.member("base_parts").set(std::int64_t{base_.parts});
    root.member("parts").set_array();
    for (int part = 0; part < state.part_count(); ++part) {
        if (!state.is_live(part)) continue;
        const JsonPlace row = root.member("parts").element();
        row.member("number").set(std::int64_t{part});
        const auto name = state.names().find(part);
        row.member("name").set(name != state.names().end() ? name->second : "part " + std::to_string(part));
        const auto color = state.colors().find(part);
        row.member("color").set(color != state.colors().end() ? color->second : std::string());
        row.member("area").set(session_.cut().part_share[at(part)]);
        row.member("shapes").set(std::int64_t{session_.cut().meshes_with_part[at(part)]});
        row.member("can_split").set(state.can_split(part));
    }
    root.member("changed").set_array();
    for (const int mesh : session_.changed()) root.member("changed").element().set(std::int64_t{mesh});
    const std::vector<double> confidence = session_.confidence();
    root.member("shapes").set_array();
    for (std::size_t m = 0; m < base_.collection.meshes.size(); ++m) {
        const JsonPlace row = root.member("shapes").element();
        row.member("name").set(base_.collection.meshes[m].name);
        if (const auto bytes = hex_unless_utf8(base_.collection.meshes[m].name))
            row.member("name_bytes").set(*bytes);
        row.member("confidence").set(confidence[m]);
        row.member("confirmed").set(bool{state.confirmed()[m]});
    }
    return tree.line();
}

/// Collective.
std::string EditDesk::labels_text(int mesh) {
    const MeshLabels labels = session_.labels(mesh);
    JsonTree tree;
    const JsonPlace root = tree.root();
    root.member("revision").set(std::int64_t{session_.revision()});
    root.member("labels").set(label_runs(runs_of(labels.part)));
    root.member("patches").set(label_runs(runs_of(labels.patch)));
    return tree.line();
}

/// Collective. The shape as the page draws it, from the rank that holds it.
std::string EditDesk::mesh_text(int mesh) {
    std::vector<std::string> mine;
    agree(comm_, [&] {
        for (const MeshDescription& local : base_.collection.local) {
            if (local.mesh != mesh) continue;
            const PictureMesh picture =
                picture_mesh(local.input, std::vector<Color>(at(local.input.face_count())));
            const ClusteredMesh coarse = clustered(picture.mesh, shown_faces);
            std::vector<int> faces;
            for (const int triangle : coarse.triangle) faces.push_back(picture.faces[at(triangle)]);
            mine.push_back(packed_edit_mesh(coarse.mesh, faces));
        }
    });
    const std::vector<std::string> all = gather_records(comm_, mine);
    return all.empty() ? "" : all.front();
}

std::string EditDesk::question_text() {
    JsonTree tree;
    const JsonPlace root = tree.root();
    const int mesh = session_.next();
    root.member("revision").set(std::int64_t{session_.revision()});
    root.member("shape").set(std::int64_t{mesh});
    if (mesh < 0) {
        root.member("reason").set("every shape is confirmed");
        return tree.line();
    }
    const OpenQuestion& question = session_.questions()[at(mesh)];
    std::string reason = percent(question.own, 0) + " of it is in doubt";
    if (question.followers > 0)
        reason += ", and " +
                  with_unit(question.followers, "other shape leans on it", "other shapes lean on it") + " (" +
                  decimal(question.others, 2) + " shapes' worth of doubt)";
    root.member("reason").set(reason);
    root.member("value").set(question.value());
    return tree.line();
}

}  // namespace coseg
