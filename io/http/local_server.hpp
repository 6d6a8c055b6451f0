#pragma once
// An HTTP server for one person on this machine: it listens on 127.0.0.1 alone, and answers only who knows
// the token in its address.

#include <functional>
#include <memory>
#include <string>

namespace coseg {

struct HttpRequest {
    std::string method;  ///< GET or POST
    std::string path;    ///< behind the token: "/state"
    std::string query;   ///< behind the question mark
    std::string body;
};

struct HttpReply {
    int status = 200;
    std::string type = "application/json";
    std::string body;
};

/// Every request is answered in turn on the thread that calls serve. A connection that stays silent does not
/// keep others waiting.
///
/// Refused, with a sentence: a wrong token (404); a Host other than 127.0.0.1:PORT or localhost:PORT (403: a
/// page elsewhere that calls this machine by another name); an Origin other than the server's own (403); any
/// method but GET and POST (405); bodies above most_body bytes (413). Replies forbid other origins, frames,
/// and loading anything from elsewhere.
class LocalServer {
  public:
    static constexpr std::size_t most_body = 64U << 20U;

    /// Listens; port 0 takes any free one. Throws Error(usage) that names the port where it is taken,
    /// Error(internal) where this machine has no 127.0.0.1.
    explicit LocalServer(int port);
    ~LocalServer();
    LocalServer(const LocalServer&) = delete;
    LocalServer& operator=(const LocalServer&) = delete;

    [[nodiscard]] int port() const;
    /// "http://127.0.0.1:PORT/TOKEN/".
    [[nodiscard]] std::string address() const;

    /// Answers requests by `answer` until end() is called, from inside of it.
    void serve(const std::function<HttpReply(const HttpRequest&)>& answer);
    /// Leaves serve once the reply is sent.
    void end();

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// The value of a key in "a=1&b=2", or "".
std::string query_value(const std::string& query, const std::string& key);

}  // namespace coseg
