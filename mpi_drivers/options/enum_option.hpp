#pragma once
// Adds options whose value is an enumerator, by the table of its names.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "src/base/enum_names.hpp"

namespace coseg {

/// Accepts the names of E and their aliases, and lists the names in --help and in its refusals.
template <NamedEnum E>
CLI::Validator name_of_enum() {
    const std::string set = CLI::detail::generate_set(names_of<E>());
    return {[set](std::string& word) { return named<E>(word) ? std::string() : word + " not in " + set; },
            set};
}

template <NamedEnum E>
CLI::Option* add_enum_option(CLI::App& app, const std::string& name, E& value, const std::string& help) {
    const auto take = [&value](const std::string& word) { value = named<E>(word).value_or(value); };
    return app.add_option_function<std::string>(name, take, help)
        ->check(name_of_enum<E>())
        ->default_str(to_string(value));
}

/// Adds an option that takes several names with commas between them.
template <NamedEnum E>
CLI::Option* add_enum_list_option(CLI::App& app, const std::string& name, std::vector<E>& values,
                                  const std::string& help) {
    const auto take = [&values](const std::vector<std::string>& words) {
        values.clear();
        for (const std::string& word : words) values.push_back(named<E>(word).value());
    };
    std::vector<std::string> standard;
    for (const E value : values) standard.push_back(to_string(value));
    return app.add_option_function<std::vector<std::string>>(name, take, help)
        ->delimiter(',')
        ->check(name_of_enum<E>())
        ->default_str(CLI::detail::join(standard, ","));
}

}  // namespace coseg
