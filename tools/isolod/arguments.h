// The words of a command line against a table of what a command accepts. The same table makes its --help.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tool {

struct OptionRule {
  const char* name;   ///< with its dashes
  const char* value;  ///< what its value is called in the help, or null for a switch
  const char* help;
};

struct CommandRule {
  const char* name;
  const char* operands;  ///< as printed in the usage line
  std::size_t operand_count;
  const char* summary;
  std::vector<OptionRule> options;
};

/// Reads the words once; anything unknown, doubled or missing is a usage failure that names it.
class Arguments {
 public:
  Arguments(const CommandRule& rule, int count, const char* const* words);

  bool wants_help() const { return wants_help_; }
  bool has(const std::string& option) const { return values_.count(option) != 0; }
  const std::string& operand(std::size_t index) const { return operands_.at(index); }

  std::string text(const std::string& option, const std::string& otherwise) const;
  std::string required_text(const std::string& option) const;
  double number(const std::string& option, double otherwise, double least, double most) const;
  std::uint64_t count(const std::string& option, std::uint64_t otherwise, std::uint64_t most) const;
  std::uint64_t required_count(const std::string& option, std::uint64_t most) const;

  /// Whole numbers with commas between them, at least one.
  std::vector<std::uint64_t> required_counts(const std::string& option, std::uint64_t most) const;

  /// A number of bytes such as 65536, 64M or 1.5G (K, M and G are powers of 1024).
  std::size_t bytes(const std::string& option, std::size_t otherwise) const;

  /// The position of the value in `names`; `otherwise` where the option was not given.
  std::size_t choice(const std::string& option, const std::vector<std::string>& names, std::size_t otherwise) const;

 private:
  void take_option(const std::string& word, int count, const char* const* words, int& index);
  const OptionRule& rule_of(const std::string& option) const;

  const CommandRule& rule_;
  std::vector<std::string> operands_;
  std::map<std::string, std::string> values_;
  bool wants_help_ = false;
};

/// `program` stands before the operands, such as "isolod remesh".
std::string help_text(const CommandRule& rule, const std::string& program);

/// The name among `known` that is most like `word`, or "" when none is near: "--vertces" means "--vertices".
std::string nearest_name(const std::string& word, const std::vector<std::string>& known);

}  // namespace tool
