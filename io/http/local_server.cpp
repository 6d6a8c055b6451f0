#include "io/http/local_server.hpp"

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <fstream>
#include <optional>
#include <utility>

#include "src/base/error.hpp"

namespace coseg {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using tcp = asio::ip::tcp;
using BoostError = boost::system::error_code;

constexpr std::chrono::seconds patience{30};

/// 128 bits that nobody can guess, as 32 hexadecimal digits: no result depends on them, so that they need not
/// be the same in every run.
std::string random_token() {
    constexpr const char* digits = "0123456789abcdef";
    std::array<char, 16> bytes{};
    std::ifstream source("/dev/urandom", std::ios::binary);
    if (!source.read(bytes.data(), bytes.size()))
        throw Error(ExitCode::internal, "/dev/urandom cannot be read, so the address would be easy to guess");
    std::string token;
    for (const char byte : bytes) {
        token += digits[static_cast<unsigned char>(byte) >> 4U];
        token += digits[static_cast<unsigned char>(byte) & 15U];
    }
    return token;
}

/// Where a difference comes first cannot be told from the time of a comparison.
bool is_same_text(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    return difference == 0;
}

std::string text_of(beast::string_view view) { return {view.data(), view.size()}; }

HttpReply refusal(int status, const std::string& sentence) { return {status, "text/plain", sentence + "\n"}; }

}  // namespace

class LocalServer::Implementation {
  public:
    explicit Implementation(int port) : acceptor_(context_), token_(random_token()) {
        const tcp::endpoint here(asio::ip::address_v4::loopback(), static_cast<unsigned short>(port));
        BoostError failure;
        acceptor_.open(here.protocol(), failure);
        if (!failure) acceptor_.set_option(asio::socket_base::reuse_address(true), failure);
        if (!failure) acceptor_.bind(here, failure);
        if (!failure) acceptor_.listen(asio::socket_base::max_listen_connections, failure);
        if (failure == asio::error::address_in_use || failure == asio::error::access_denied)
            throw Error(ExitCode::usage, "--port " + std::to_string(port) + ": " + failure.message() +
                                             "; name another one, or leave it out for any that is free");
        if (failure) throw Error(ExitCode::internal, "127.0.0.1 cannot be listened on: " + failure.message());
    }

    [[nodiscard]] int port() const { return acceptor_.local_endpoint().port(); }
    [[nodiscard]] const std::string& token() const { return token_; }

    void serve(const std::function<HttpReply(const HttpRequest&)>& answer) {
        answer_ = answer;
        accept();
        context_.run();
    }

    void end() { is_ending_ = true; }

    /// What one request comes to.
    HttpReply reply_to(const http::request<http::string_body>& request) {
        const std::string port_text = ":" + std::to_string(port());
        const std::string host = text_of(request[http::field::host]);
        if (host != "127.0.0.1" + port_text && host != "localhost" + port_text)
            return refusal(403, "this server is for pages of this machine alone");
        const std::string origin = text_of(request[http::field::origin]);
        if (!origin.empty() && origin != "http://" + host)
            return refusal(403, "pages of " + origin + " may not ask this server");
        std::string target = text_of(request.target());
        const std::size_t token_end = target.find('/', 1);
        const bool has_token = target.size() > 1 && target.front() == '/' && token_end != std::string::npos &&
                               is_same_text(std::string_view(target).substr(1, token_end - 1), token_);
        if (!has_token) return refusal(404, "nothing is here; use the whole address that coseg edit printed");
        if (request.method() != http::verb::get && request.method() != http::verb::post)
            return refusal(405, "only GET and POST are understood");
        target.erase(0, token_end);
        const std::size_t question = target.find('?');
        HttpRequest asked;
        asked.method = request.method() == http::verb::get ? "GET" : "POST";
        asked.path = target.substr(0, question);
        if (question != std::string::npos) asked.query = target.substr(question + 1);
        asked.body = request.body();
        return answer_(asked);
    }

    void close_if_ending() {
        if (!is_ending_) return;
        BoostError ignored;
        acceptor_.close(ignored);
        context_.stop();
    }

  private:
    class Connection;
    void accept();

    asio::io_context context_{1};
    tcp::acceptor acceptor_;
    std::string token_;
    std::function<HttpReply(const HttpRequest&)> answer_;
    bool is_ending_ = false;
};

/// Reads requests and writes replies, one after the other, until either side closes. It keeps itself alive.
class LocalServer::Implementation::Connection : public std::enable_shared_from_this<Connection> {
  public:
    Connection(tcp::socket socket, Implementation& server) : stream_(std::move(socket)), server_(server) {}

    void read() {
        parser_.emplace();
        parser_->body_limit(most_body);
        stream_.expires_after(patience);
        http::async_read(
            stream_, buffer_, *parser_,
            [self = shared_from_this()](BoostError failure, std::size_t) { self->answer(failure); });
    }

  private:
    void answer(BoostError failure) {
        if (failure == http::error::body_limit) {
            write(refusal(413, "a request may have 64 MiB"), false);
        } else if (failure == http::error::end_of_stream || failure) {
            close();
        } else {
            write(server_.reply_to(parser_->get()), parser_->get().keep_alive());
        }
    }

    void write(HttpReply given, bool keep_alive) {
        reply_ = {};
        reply_.result(static_cast<unsigned>(given.status));
        reply_.set(http::field::content_type, given.type + "; charset=utf-8");
        reply_.set(http::field::cache_control, "no-store");
        reply_.set("X-Content-Type-Options", "nosniff");
        reply_.set("Referrer-Policy", "no-referrer");
        reply_.set("Cross-Origin-Resource-Policy", "same-origin");
        reply_.set(
            "Content-Security-Policy",
            "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; "
            "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
        reply_.body() = std::move(given.body);
        reply_.keep_alive(keep_alive);
        reply_.prepare_payload();
        stream_.expires_after(patience);
        http::async_write(stream_, reply_,
                          [self = shared_from_this(), keep_alive](BoostError failure, std::size_t) {
                              self->server_.close_if_ending();
                              if (failure || !keep_alive)
                                  self->close();
                              else
                                  self->read();
                          });
    }

    void close() {
        BoostError ignored;
        stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    }

    beast::tcp_stream stream_;
    Implementation& server_;
    beast::flat_buffer buffer_;
    std::optional<http::request_parser<http::string_body>> parser_;
    http::response<http::string_body> reply_;
};

void LocalServer::Implementation::accept() {
    acceptor_.async_accept(context_, [this](BoostError failure, tcp::socket socket) {
        if (!acceptor_.is_open()) return;
        if (!failure) std::make_shared<Connection>(std::move(socket), *this)->read();
        accept();
    });
}

LocalServer::LocalServer(int port) : implementation_(std::make_unique<Implementation>(port)) {}
LocalServer::~LocalServer() = default;

int LocalServer::port() const { return implementation_->port(); }

std::string LocalServer::address() const {
    return "http://127.0.0.1:" + std::to_string(port()) + "/" + implementation_->token() + "/";
}

void LocalServer::serve(const std::function<HttpReply(const HttpRequest&)>& answer) {
    implementation_->serve(answer);
}

void LocalServer::end() { implementation_->end(); }

std::string query_value(const std::string& query, const std::string& key) {
    for (std::size_t begin = 0; begin <= query.size();) {
        const std::size_t end = std::min(query.find('&', begin), query.size());
        const std::string pair = query.substr(begin, end - begin);
        if (pair.starts_with(key + "=")) return pair.substr(key.size() + 1);
        begin = end + 1;
    }
    return "";
}

}  // namespace coseg
