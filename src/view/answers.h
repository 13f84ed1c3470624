// Answers to the requests of the page (docs/view-protocol.md), apart from HTTP. Called by any
// thread.
#pragma once

#include <map>
#include <string>

#include "view/comparisons.h"
#include "view/view_source.h"

namespace nephroid {

/// The parameters of an address: "x=3&y=4".
using Parameters = std::map<std::string, std::string>;

struct Answer {
  int status = 200;
  std::string body;
  std::string type = "application/json";
  std::string file_name;  ///< of a download; empty: it is none
};

/// An answer with a text for people.
Answer failure(int status, const std::string& message);

/// The methods throw UsageError for a request that is wrong, IoError for a file that cannot be
/// written.
class Answers {
 public:
  /// Keeps references. `save_directory`: see ServerSettings.
  Answers(ViewSource& source, Comparisons& comparisons, std::string save_directory);

  Answer state(const Parameters& parameters, const std::string& body);
  Answer frame(const Parameters& parameters, const std::string& body);
  /// Waits for a picture, but not for long.
  Answer first_picture(const Parameters& parameters, const std::string& body);
  Answer probe(const Parameters& parameters, const std::string& body);
  Answer compare(const Parameters& parameters, const std::string& body);
  Answer heat(const Parameters& parameters, const std::string& body);
  Answer save(const Parameters& parameters, const std::string& body);
  Answer camera(const Parameters& parameters, const std::string& body);
  Answer pick(const Parameters& parameters, const std::string& body);
  Answer render(const Parameters& parameters, const std::string& body);
  Answer inspect(const Parameters& parameters, const std::string& body);
  Answer snapshot(const Parameters& parameters, const std::string& body);
  Answer upload(const Parameters& parameters, const std::string& body);
  Answer remove(const Parameters& parameters, const std::string& body);

 private:
  /// Throws UsageError for a picture.
  LiveRender& live();
  /// The comparison that a request names; throws UsageError if there is none.
  std::shared_ptr<const Picture> comparison(const std::string& id) const;
  /// The present picture with the gains of the parameter "mix".
  Picture shown(const Parameters& parameters);
  Answer comparison_frame(const std::string& id) const;
  Answer save_scene(const std::string& file_name);
  /// Sends a file as a download, or puts it into the directory of saves.
  Answer deliver(std::string bytes, const std::string& name, const std::string& type) const;

  ViewSource& source_;
  Comparisons& comparisons_;
  const std::string save_directory_;
};

}  // namespace nephroid
