// Error types: each error has an exit status; errors and warnings about a scene have a location in
// the user's file. Thrown while loading and writing, and by a texture that becomes unreadable while
// rendering.
#pragma once

#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace nephroid {

/// A location in a user's text. Line and column count from 1; 0 means unknown.
struct SourceLocation {
  std::shared_ptr<const std::string> file;
  int line = 0;
  int column = 0;

  /// "file:line:column", without the unknown parts; empty if all are unknown.
  std::string to_string() const;
};

/// Exit statuses of the program.
enum class ExitStatus : int { kDone = 0, kRender = 1, kUsage = 2, kScene = 3, kInputOutput = 4 };

class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& message)
      : std::runtime_error(message), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

/// The scene is wrong: what() reads "file:line:column: what is wrong, what was expected".
class SceneError : public Error {
 public:
  SceneError(SourceLocation where, const std::string& message);
  const SourceLocation& where() const { return where_; }

 private:
  SourceLocation where_;
};

/// A file could not be read or written: what() names the file and the system's reason.
class IoError : public Error {
 public:
  explicit IoError(const std::string& message) : Error(ExitStatus::kInputOutput, message) {}
};

/// The command line or an option value is wrong.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ExitStatus::kUsage, message) {}
};

struct Warning {
  SourceLocation where;
  std::string message;
  bool is_unknown_name = false;  ///< true if the scene uses an unknown name: an error with --strict
};

/// Collects warnings and notes while a scene is loaded; may be called from several threads.
/// The same message at the same place is kept once.
class Diagnostics {
 public:
  void warn(SourceLocation where, std::string message);
  /// Warns of a name that the format does not have; it is ignored.
  void warn_of_unknown_name(SourceLocation where, std::string message);
  /// Tells of a choice or a fact that is normal, such as a default camera.
  void note(SourceLocation where, std::string message);
  std::vector<Warning> warnings() const;
  std::vector<Warning> notes() const;

 private:
  void add(std::vector<Warning>& to, Warning warning);

  mutable std::mutex mutex_;
  std::vector<Warning> warnings_, notes_;
  std::unordered_set<std::string> known_;  ///< the located texts of both
};

/// "file:line:column: message", or just the message if the location is unknown.
std::string located(const SourceLocation& where, const std::string& message);

}  // namespace nephroid
