#pragma once
// The texts of the report's page that are built into the program: our own, and the libraries it draws with.

#include <string_view>

namespace coseg {

struct WebAssets {
    std::string_view page;  ///< with @NAME@ where a piece goes
    std::string_view style;
    std::string_view script;
    std::string_view elements;   ///< the beginning of every page's script
    std::string_view edit_page;  ///< as `page`, of coseg edit
    std::string_view edit_style;
    std::string_view edit_script;
    std::string_view licences;
    std::string_view three;     ///< three.js; empty if it was not there when the program was built
    std::string_view controls;  ///< its OrbitControls
    std::string_view chart;     ///< Chart.js

    [[nodiscard]] bool has_libraries() const { return !three.empty() && !controls.empty() && !chart.empty(); }
};

const WebAssets& web_assets();

}  // namespace coseg
