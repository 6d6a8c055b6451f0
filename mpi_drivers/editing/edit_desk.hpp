#pragma once
// Answers the requests of an editing page by the session (docs/editing.md lists them). Ranks other than the
// first wait for what it asks of them.

#include <string>
#include <tuple>
#include <vector>

#include "io/http/local_server.hpp"
#include "mpi_drivers/editing/edit_session.hpp"
#include "src/pictures/shape_view.hpp"

namespace coseg {

/// What the page is told once.
struct EditPage {
    std::string html;    ///< the page itself
    std::string folder;  ///< of the run; corrected labels are written into its folder "corrected"
};

class EditDesk {
  public:
    /// Neither is copied.
    EditDesk(const Comm& comm, const CorrectionBase& base, EditSession& session, EditPage page);

    /// Serves on rank 0 until a request ends it; the other ranks help. Collective.
    void serve(LocalServer* server);

  private:
    /// What rank 0 tells the others to do with it.
    struct Order {
        std::string method;
        std::string path;
        std::string query;
        std::string body;
        bool ends = false;
        static constexpr auto fields() {
            return std::tuple(field("method", &Order::method), field("path", &Order::path),
                              field("query", &Order::query), field("body", &Order::body),
                              field("ends", &Order::ends));
        }
    };
    HttpReply carried_out(const Order& order);
    HttpReply changed_by(const Order& order);
    void do_act(const Order& order, const std::vector<std::string>& words);
    std::string state_text();
    std::string labels_text(int mesh);
    std::string mesh_text(int mesh);
    std::string question_text();
    [[nodiscard]] int mesh_number(const std::string& word) const;

    const Comm& comm_;
    CorrectionBase base_;
    EditSession& session_;
    EditPage page_;
    double act_seconds_ = 0.0;
};

}  // namespace coseg
