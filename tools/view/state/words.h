#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <openvdb/Types.h>

/// The words of a line: what commands, scripts and files of options are made of.
namespace vdbcage::view {

using Words = std::vector<std::string>;

/// Splits `line` at blanks. A word in double quotes may have blanks; in it \" and \\ stand for " and \, and \n, \r and
/// \t for what they stand for in C. From a # that begins a word to the end all is a comment.
/// \throw InputError a quote without its end, or a word after it without a blank between
Words wordsOf(std::string_view line);

/// `word` as it must be written for wordsOf to give it back: in quotes only where it must be.
std::string quotedWord(const std::string& word);

/// The number that `word` is, exactly as the shortest digits of any double say. \throw InputError naming `what`
double numberOf(const std::string& word, const std::string& what);
/// \throw InputError naming `what` and the range
int wholeNumberOf(const std::string& word, const std::string& what, int least, int most);
/// Reads "on" or "off". \throw InputError naming `what`
bool switchOf(const std::string& word, const std::string& what);

/// \throw InputError what a value is for, the value, and what is allowed
[[noreturn]] void refuse(const std::string& what, const std::string& value, const std::string& allowed);

} // namespace vdbcage::view
