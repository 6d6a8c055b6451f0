#include "io/reports/json_tree.hpp"

#include <nlohmann/json.hpp>

namespace coseg {

namespace {

using Json = nlohmann::ordered_json;

Json& at_place(void* value) { return *static_cast<Json*>(value); }

}  // namespace

JsonPlace JsonPlace::member(std::string_view name) const {
    return JsonPlace(&at_place(value_)[std::string(name)]);
}

JsonPlace JsonPlace::element() const {
    at_place(value_).push_back(nullptr);
    return JsonPlace(&at_place(value_).back());
}

void JsonPlace::set_object() const { at_place(value_) = Json::object(); }
void JsonPlace::set_array() const { at_place(value_) = Json::array(); }
void JsonPlace::set_null() const { at_place(value_) = nullptr; }
void JsonPlace::set(bool value) const { at_place(value_) = value; }
void JsonPlace::set(std::int64_t value) const { at_place(value_) = value; }
void JsonPlace::set(std::uint64_t value) const { at_place(value_) = value; }
void JsonPlace::set(double value) const { at_place(value_) = value; }
void JsonPlace::set(std::string_view text) const { at_place(value_) = std::string(text); }

void JsonPlace::set_typed(const std::string& text) const {
    if (Json::accept(text)) {
        Json value = Json::parse(text);
        if (value.is_number() || value.is_boolean()) {
            at_place(value_) = std::move(value);
            return;
        }
    }
    set(std::string_view(text));
}

// The move constructor of the library's type is what may throw.
// NOLINTNEXTLINE(bugprone-exception-escape)
struct JsonTree::Value {
    Json json;
};

JsonTree::JsonTree() : value_(std::make_unique<Value>()) {}
JsonTree::~JsonTree() = default;

JsonPlace JsonTree::root() { return JsonPlace(&value_->json); }

std::string JsonTree::line() const {
    return value_->json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string JsonTree::pretty() const {
    return value_->json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace coseg
