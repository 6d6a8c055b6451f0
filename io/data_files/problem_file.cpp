#include "io/data_files/problem_file.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>

#include "src/base/error.hpp"

namespace coseg {

namespace {

std::string read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(ExitCode::input, "cannot open problem file " + path + "; check the name");
    try {
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    } catch (const std::ios_base::failure&) {  // a folder can be opened, but not read
        throw Error(ExitCode::input, "cannot read problem file " + path + "; is it a folder?");
    }
}

/// Hands out lines and numbers of a text, and knows where it is for messages.
class LineReader {
  public:
    LineReader(const std::string& path, std::string_view text) : path_(path), rest_(text) {}

    /// Goes to the next line that is not blank.
    void next_line(const std::string& what) {
        do {
            if (rest_.empty()) fail("the file ends where " + what + " should stand; it seems truncated");
            ++number_;
            const std::size_t end = rest_.find('\n');
            line_ = rest_.substr(0, end);
            rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
            skip_blanks();
        } while (line_.empty());
    }

    template <class Number>
    Number number(const std::string& what) {
        skip_blanks();
        if (line_.empty()) fail("the line ends where " + what + " should stand");
        Number value{};
        const auto [end, status] = std::from_chars(line_.data(), line_.data() + line_.size(), value);
        const bool ends_word = end == line_.data() + line_.size() || is_blank(*end);
        if (status != std::errc{} || !ends_word) fail("'" + word() + "' is not " + what);
        line_.remove_prefix(static_cast<std::size_t>(end - line_.data()));
        return value;
    }

    double finite_number(const std::string& what) {
        skip_blanks();
        const std::string read = word();
        const auto value = number<double>(what);
        if (!std::isfinite(value)) fail("'" + read + "' is not a finite number");
        return value;
    }

    void end_line() {
        skip_blanks();
        if (!line_.empty()) fail("the line goes on with '" + word() + "' where it should end");
    }

    void end_file() {
        const std::size_t more = rest_.find_first_not_of(" \t\r\n");
        if (more == std::string_view::npos) return;
        fail("the file goes on after the last row of the last feature; are H, d and N right?");
    }

    [[noreturn]] void fail(const std::string& sentence) const {
        throw Error(ExitCode::input, path_ + ", line " + std::to_string(number_) + ": " + sentence);
    }

  private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
    void skip_blanks() {
        while (!line_.empty() && is_blank(line_.front())) line_.remove_prefix(1);
    }
    [[nodiscard]] std::string word() const {
        return std::string(line_.substr(0, std::min<std::size_t>(line_.find_first_of(" \t\r"), 40)));
    }

    const std::string& path_;
    std::string_view rest_;
    std::string_view line_;
    std::int64_t number_ = 0;
};

struct Sizes {
    std::int64_t features, rows, columns;
};

Sizes read_sizes(LineReader& reader, std::size_t characters) {
    reader.next_line("the sizes H d N");
    Sizes sizes{};
    sizes.features = reader.number<std::int64_t>("the number of features H");
    sizes.rows = reader.number<std::int64_t>("the number of rows d");
    sizes.columns = reader.number<std::int64_t>("the number of columns N");
    reader.end_line();
    if (sizes.features < 1 || sizes.rows < 1 || sizes.columns < 1)
        reader.fail("H, d and N must be at least 1");
    // A number takes at least two characters, itself and a blank, so a header cannot ask for more than the
    // file holds.
    const auto room = static_cast<std::int64_t>(characters / 2) + 1;
    if (sizes.features > room || sizes.rows > room / sizes.features ||
        sizes.columns > room / (sizes.features * sizes.rows)) {
        reader.fail("the file is too short to hold H d N = " + std::to_string(sizes.features) + " x " +
                    std::to_string(sizes.rows) + " x " + std::to_string(sizes.columns) + " numbers");
    }
    return sizes;
}

double read_penalty(LineReader& reader, const std::string& name) {
    const double value = reader.finite_number("the penalty " + name);
    if (value < 0.0) reader.fail(name + " is negative; penalties must be at least 0");
    return value;
}

Eigen::MatrixXd read_feature(LineReader& reader, const Sizes& sizes, std::int64_t h) {
    Eigen::MatrixXd feature(sizes.rows, sizes.columns);
    const std::string name = "feature " + std::to_string(h + 1);
    for (std::int64_t k = 0; k < sizes.rows; ++k) {
        reader.next_line("row " + std::to_string(k + 1) + " of " + name);
        for (std::int64_t j = 0; j < sizes.columns; ++j) {
            feature(k, j) = reader.finite_number("a number of " + name);
            if (feature(k, j) < 0.0) {
                reader.fail("column " + std::to_string(j + 1) + " of " + name +
                            " is negative; every entry must be at least 0");
            }
        }
        reader.end_line();
    }
    return feature;
}

}  // namespace

ProblemFile read_problem_file(const std::string& path) {
    const std::string text = read_text(path);
    LineReader reader(path, text);
    const Sizes sizes = read_sizes(reader, text.size());
    ProblemFile problem;
    reader.next_line("the penalties lambda alpha beta");
    problem.lambda = read_penalty(reader, "lambda");
    problem.alpha = read_penalty(reader, "alpha");
    problem.beta = read_penalty(reader, "beta");
    reader.end_line();
    reader.next_line("the bounds of the optimum");
    problem.known_upper = reader.finite_number("an upper bound of the optimum");
    problem.known_lower = reader.finite_number("a lower bound of the optimum");
    reader.end_line();
    for (std::int64_t h = 0; h < sizes.features; ++h)
        problem.features.push_back(read_feature(reader, sizes, h));
    reader.end_file();
    return problem;
}

}  // namespace coseg
