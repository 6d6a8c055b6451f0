#include "mpi_drivers/options/help_pages.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>

#include "src/base/spelling.hpp"

namespace coseg {

namespace {

class FoldingFormatter : public CLI::Formatter {
  public:
    explicit FoldingFormatter(std::vector<std::string> shown) : shown_(std::move(shown)) { column_width(34); }

    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
        folds_ = mode != CLI::AppFormatMode::All;
        std::string help = CLI::Formatter::make_help(app, std::move(name), mode);
        for (std::size_t gap = help.find("\n\n\n"); gap != std::string::npos; gap = help.find("\n\n\n"))
            help.erase(gap, 1);
        return help;
    }

    std::string make_group(std::string group, bool is_positional,
                           std::vector<const CLI::Option*> options) const override {
        const bool is_shown = is_positional || std::find(shown_.begin(), shown_.end(), group) != shown_.end();
        if (folds_ && !is_shown) return "";
        return CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
    }

  private:
    std::vector<std::string> shown_;
    mutable bool folds_ = true;
};

/// The command's own and those of its option groups, which CLI11 keeps as commands without a name.
std::vector<const CLI::Option*> options_of(const CLI::App& command) {
    std::vector<const CLI::Option*> options = command.get_options();
    for (const CLI::App* group :
         command.get_subcommands([](const CLI::App* app) { return app->get_name().empty(); })) {
        const std::vector<const CLI::Option*> more = options_of(*group);
        options.insert(options.end(), more.begin(), more.end());
    }
    return options;
}

/// --name, and --no-name where there is one.
std::vector<std::string> long_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : options_of(command)) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

/// What man(7) would take for its own.
std::string roff(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if (c == '\\' || c == '-') safe += '\\';
        if (c == '\n') {
            safe += "\n.br\n";
            continue;
        }
        if ((c == '.' || c == '\'') && (safe.empty() || safe.back() == '\n')) safe += "\\&";
        safe += c;
    }
    return safe;
}

std::string man_options(const CLI::App& command) {
    std::string text;
    for (const CLI::Option* option : command.get_options()) {
        const std::string name =
            option->nonpositional() ? option->get_name(false, true) : option->get_name(true);
        text += ".TP\n.B " + roff(name);
        if (option->nonpositional() && option->get_type_size() != 0)
            text += " \\fI" + roff(option->get_type_name()) + "\\fR";
        text += "\n" + roff(option->get_description());
        if (!option->get_default_str().empty()) text += " Default: " + roff(option->get_default_str()) + ".";
        text += "\n";
    }
    return text;
}

std::string spaced(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

[[noreturn]] void refuse_empty_value(const std::string& name) {
    throw CLI::ParseError(name + " has an empty value; give one, or leave it out",
                          CLI::ExitCodes::ValidationError);
}

/// CLI11 would take it for options of one letter, and then miss the input.
void refuse_path_like_option(const std::string& word) {
    std::error_code ignored;
    if (word == "-h" || !std::filesystem::exists(word, ignored)) return;
    throw CLI::ParseError("'" + word + "' begins with a dash like an option; write './" + word +
                              "' for the file or folder of this name",
                          CLI::ExitCodes::ExtrasError);
}

}  // namespace

void fold_help(CLI::App& app, const std::vector<std::string>& groups_always_shown) {
    app.set_help_all_flag("--help-all", "Print all options and exit");
    app.formatter(std::make_shared<FoldingFormatter>(groups_always_shown));
}

void refuse_unknown_options(const CLI::App& command, const std::vector<std::string>& words) {
    const std::vector<std::string> known = long_names(command);
    for (const std::string& word : words) {
        if (word.size() > 1 && word[0] == '-' && word[1] != '-') refuse_path_like_option(word);
        if (!word.starts_with("--") || word.size() == 2) continue;
        const std::string name = word.substr(0, word.find('='));
        // CLI11 would take the next word for the value.
        if (word == name + "=") refuse_empty_value(name);
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        refuse_path_like_option(word);
        const std::string meant = nearest_word(name, known);
        throw CLI::ParseError(name + " is not an option of coseg " + command.get_name() +
                                  (meant.empty() ? "" : "; did you mean " + meant + "?"),
                              CLI::ExitCodes::ExtrasError);
    }
}

void refuse_empty_values(const CLI::App& command) {
    for (const CLI::Option* option : options_of(command)) {
        for (const std::string& value : option->results()) {
            if (value.empty()) refuse_empty_value(option->get_name());
        }
    }
}

std::string man_page(const CLI::App& program) {
    std::string text =
        ".TH COSEG 1\n.SH NAME\ncoseg \\- " + roff("co-segmentation of collections of 3D shapes") +
        "\n.SH SYNOPSIS\n.B coseg\n.I COMMAND\n[\\fIOPTION\\fR]... [\\-\\- \\fIPETSC OPTION\\fR]...\n"
        ".SH DESCRIPTION\ncoseg cuts all shapes of a collection into the same parts, without training "
        "data, on any number of MPI ranks.\n.SH COMMANDS\n";
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
        text += ".SS coseg " + roff(command->get_name()) + "\n" + roff(command->get_description()) + ".\n" +
                man_options(*command);
        if (!command->get_footer().empty()) text += ".PP\n" + roff(command->get_footer()) + "\n";
    }
    return text +
           ".SH EXIT STATUS\n0 success, 1 internal error, 2 usage, 3 input, 4 output, 5 no convergence.\n";
}

std::string bash_completion(const CLI::App& program, const std::vector<std::string>& families) {
    std::vector<std::string> names;
    std::string cases;
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(command->get_name());
        cases += "        " + command->get_name() + ") options=\"" + spaced(long_names(*command)) + "\" ;;\n";
    }
    return "# bash completion for coseg\n_coseg() {\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} options=\"\"\n"
           "    if ((COMP_CWORD == 1)); then\n        mapfile -t COMPREPLY < <(compgen -W \"" +
           spaced(names) +
           " --help --version\" -- \"$word\")\n        return\n    fi\n    case $command in\n" + cases +
           "    esac\n    if [[ $word == -* ]]; then\n"
           "        mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\")\n"
           "    elif [[ $command == generate && $COMP_CWORD -eq 2 ]]; then\n        mapfile -t COMPREPLY < "
           "<(compgen -W \"" +
           spaced(families) +
           " list\" -- \"$word\")\n    else\n        mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n    "
           "fi\n}\n"
           "complete -o filenames -F _coseg coseg\n";
}

}  // namespace coseg
