#include "mpi_drivers/options/config_file.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "io/files/file_contents.hpp"
#include "io/files/text_encoding.hpp"
#include "src/base/error.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

/// The file that --config names, "" if there is none.
std::string named_file(const std::vector<std::string>& words) {
    const std::string option = "--config";
    for (std::size_t k = 0; k < words.size(); ++k) {
        if (words[k] == option && k + 1 < words.size()) return words[k + 1];
        if (words[k].starts_with(option + "=")) return words[k].substr(option.size() + 1);
    }
    return "";
}

std::string joined(const std::vector<std::string>& values) {
    std::string text;
    for (const std::string& value : values) text += (text.empty() ? "" : ",") + value;
    return text;
}

/// In UTF-8, whatever an editor saved.
std::string config_text(const std::string& path) {
    try {
        return utf8_text(read_file(path));
    } catch (const Error&) {
        throw Error(ExitCode::usage, "--config: cannot read " + path + "; check the path");
    }
}

std::vector<CLI::ConfigItem> parsed(const std::string& path) {
    std::istringstream text(config_text(path));
    try {
        return CLI::ConfigTOML().from_config(text);
    } catch (const std::exception& error) {
        throw Error(ExitCode::usage, "--config: " + path + " is neither TOML nor INI: " + error.what());
    }
}

/// Keys stand alone or in a section named after the subcommand.
void refuse_misplaced(const CLI::ConfigItem& item, const std::string& path, const std::string& subcommand) {
    const std::string key = "--config: " + path + ": the key '" + item.name + "' ";
    if (!item.parents.empty() && item.parents != std::vector<std::string>{subcommand}) {
        throw Error(ExitCode::usage, key + "is in the section [" + item.parents.front() +
                                         "]; write it before all sections or in [" + subcommand + "]");
    }
    if (joined(item.inputs).empty()) throw Error(ExitCode::usage, key + "has no value; give it one");
    if (item.name == "config" || item.name == "help")
        throw Error(ExitCode::usage, key + "belongs on the command line; remove it");
}

std::vector<std::string> words_of(const std::vector<CLI::ConfigItem>& items, const std::string& path,
                                  const std::vector<std::string>& given, const OptionTest& is_passed_over) {
    std::vector<std::string> words;
    for (const CLI::ConfigItem& item : items) {
        // CLI11's marks for the begin and end of a section.
        if (item.name == "++" || item.name == "--") continue;
        refuse_misplaced(item, path, given.front());
        const std::string option = "--" + item.name;
        if (item.name == "input") {
            words.insert(words.end(), item.inputs.begin(), item.inputs.end());
        } else if (!is_given(given, option) && !is_passed_over(option)) {
            words.push_back(option + "=" + joined(item.inputs));
        }
    }
    return words;
}

}  // namespace

bool is_given(const std::vector<std::string>& words, const std::string& option) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return word == option || word.starts_with(option + "=");
    });
}

std::vector<std::string> with_config_file(const std::vector<std::string>& words,
                                          const OptionTest& is_passed_over) {
    const std::string path = named_file(words);
    if (path.empty()) return words;
    std::vector<std::string> all = {words.front()};  // the subcommand stands first
    const std::vector<std::string> from_file = words_of(parsed(path), path, words, is_passed_over);
    all.insert(all.end(), from_file.begin(), from_file.end());
    all.insert(all.end(), words.begin() + 1, words.end());
    return all;
}

std::vector<std::string> with_config_file(const Comm& comm, const std::vector<std::string>& words,
                                          const OptionTest& is_passed_over) {
    if (named_file(words).empty()) return words;
    std::vector<std::string> all;
    agree(comm, [&] {
        if (comm.is_root()) all = with_config_file(words, is_passed_over);
    });
    broadcast(comm, all);
    return all;
}

}  // namespace coseg
