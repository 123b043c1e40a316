#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <openvdb/Types.h>

/// The words of a line of a script or a file of options.
namespace vdbcage::view {

using Words = std::vector<std::string>;

/// Splits `line` at blanks. A word in double quotes may have blanks; in it \" and \\ stand for " and \, and \n, \r and
/// \t have their meaning in C. A # that begins a word starts a comment, which ends with the line.
/// \throw InputError a quote without its end, or a word after it without a blank between
Words wordsOf(std::string_view line);

/// Returns `word` in the form that wordsOf reads as the same word: in quotes only where it must be.
std::string quotedWord(const std::string& word);

/// Returns the number in `word`, exactly as the shortest digits of any double say. \throw InputError naming `what`
double numberOf(const std::string& word, const std::string& what);
/// \throw InputError naming `what` and the range
int wholeNumberOf(const std::string& word, const std::string& what, int least, int most);
/// Reads "on" or "off". \throw InputError naming `what`
bool switchOf(const std::string& word, const std::string& what);

/// \throw InputError naming `what`, the value and the allowed values
[[noreturn]] void refuse(const std::string& what, const std::string& value, const std::string& allowed);

} // namespace vdbcage::view
