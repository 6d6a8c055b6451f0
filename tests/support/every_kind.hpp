#pragma once
// A record with a field of every kind that a record may have.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg::test {

enum class Metal { iron, copper };
constexpr std::array<EnumName<Metal>, 2> enum_names(Metal /*type*/) {
    return {{{Metal::iron, "iron"}, {Metal::copper, "copper"}}};
}

struct Numbers {
    bool truth = false;
    int small = 0;
    std::int64_t large = 0;
    std::uint64_t hash = 0;
    double real = 0.0;
    float single = 0.0F;
    Metal metal = Metal::iron;
    friend bool operator==(const Numbers&, const Numbers&) = default;
    static constexpr auto fields() {
        return std::tuple(field("truth", &Numbers::truth), field("small", &Numbers::small),
                          field("large", &Numbers::large), field("hash", &Numbers::hash),
                          field("real", &Numbers::real), field("single", &Numbers::single),
                          field("metal", &Numbers::metal));
    }
};

struct Nested {
    std::string name;
    std::vector<double> values;
    friend bool operator==(const Nested&, const Nested&) = default;
    static constexpr auto fields() {
        return std::tuple(field("name", &Nested::name), field("values", &Nested::values));
    }
};

struct EveryKind {
    Numbers numbers;
    Nested nested;
    std::vector<int> counts;
    std::vector<bool> truths;
    std::vector<std::string> texts;
    std::vector<std::vector<int>> lists;
    std::vector<Nested> rows;
    std::vector<std::pair<std::string, std::string>> settings;
    std::array<double, 3> triple{};
    std::optional<double> maybe;
    std::pair<int, double> pair;
    Eigen::MatrixXd matrix;
    Eigen::Vector3d vector = Eigen::Vector3d::Zero();
    std::vector<Eigen::MatrixXf> matrices;
    friend bool operator==(const EveryKind&, const EveryKind&) = default;
    static constexpr auto fields() {
        return std::tuple(inlined(&EveryKind::numbers), field("nested", &EveryKind::nested),
                          field("counts", &EveryKind::counts, Storage::compressed),
                          field("truths", &EveryKind::truths), field("texts", &EveryKind::texts),
                          field("lists", &EveryKind::lists), field("rows", &EveryKind::rows),
                          field("settings", &EveryKind::settings), field("triple", &EveryKind::triple),
                          field("maybe", &EveryKind::maybe), field("pair", &EveryKind::pair),
                          field("matrix", &EveryKind::matrix), field("vector", &EveryKind::vector),
                          field("matrices", &EveryKind::matrices));
    }
};

inline EveryKind filled_record(int number) {
    EveryKind record;
    record.numbers = {true,         -number, std::int64_t{1} << 40, ~std::uint64_t{0},
                      0.1 * number, 0.5F,    Metal::copper};
    record.nested = {"näme " + std::to_string(number), {1.0, 2.5}};
    record.counts.assign(static_cast<std::size_t>(number) + 1, 7);
    record.truths = {true, false, true};
    record.texts = {"", "two\nlines", "three"};
    record.lists = {{1, 2}, {}, {3}};
    record.rows = {{"a", {}}, {"b", {4.0}}};
    record.settings = {{"seed", "1"}, {"remesh", "auto"}};
    record.triple = {1.0, 2.0, 3.0};
    if (number % 2 == 1) record.maybe = 0.25;
    record.pair = {number, 2.0};
    record.matrix = Eigen::MatrixXd::Constant(2, 3, 1.5);
    record.matrix(1, 2) = -4.0;
    record.vector = {1.0, 0.0, -1.0};
    record.matrices = {Eigen::MatrixXf::Ones(1, 2), Eigen::MatrixXf::Zero(0, 5)};
    return record;
}

/// filled_record(1) with one field changed, each of them in turn.
inline std::vector<EveryKind> changed_records() {
    std::vector<EveryKind> changed;
    const auto change = [&](auto&& how) { how(changed.emplace_back(filled_record(1))); };
    change([](EveryKind& r) { r.numbers.truth = false; });
    change([](EveryKind& r) { r.numbers.small = 8; });
    change([](EveryKind& r) { r.numbers.large += 1; });
    change([](EveryKind& r) { r.numbers.hash -= 1; });
    change([](EveryKind& r) { r.numbers.real *= 1.0 + 1e-15; });
    change([](EveryKind& r) { r.numbers.single = 0.25F; });
    change([](EveryKind& r) { r.numbers.metal = Metal::iron; });
    change([](EveryKind& r) { r.nested.name += "!"; });
    change([](EveryKind& r) { r.nested.values.pop_back(); });
    change([](EveryKind& r) { r.counts[1] = 8; });
    change([](EveryKind& r) { r.truths[1] = true; });
    change([](EveryKind& r) { r.texts[0] = " "; });
    change([](EveryKind& r) { r.lists = {{1}, {2}, {3}}; });
    change([](EveryKind& r) { r.rows = {{"a", {4.0}}, {"b", {}}}; });
    change([](EveryKind& r) { r.settings[1].second = "never"; });
    change([](EveryKind& r) { r.triple[2] = 0.0; });
    change([](EveryKind& r) { r.maybe.reset(); });
    change([](EveryKind& r) { r.pair.first = 5; });
    change([](EveryKind& r) { r.matrix(0, 1) = 0.0; });
    change([](EveryKind& r) { r.vector[1] = 1.0; });
    change([](EveryKind& r) { r.matrices[0](0, 1) = 2.0F; });
    return changed;
}

}  // namespace coseg::test
