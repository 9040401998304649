// A problem for those who look at it in a browser.
#pragma once

#include <string>
#include <string_view>

namespace awan {

// The HTML page of a problem document (problem_to_json): what is wrong and where, with every character of it as text.
// Its style is web/plain.css.
std::string problem_page(std::string_view problem_json);

}  // namespace awan
