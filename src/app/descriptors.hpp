/// Open files that one program hands to another one on the same machine, through a socket of Unix.
#pragma once

#include <sys/types.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace solidus::app {

/// A descriptor that is closed with this.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  int number() const { return number_; }
  bool open() const { return number_ >= 0; }

 private:
  int number_;
};

/// A socket that waits for programs of this machine, at a name that the system chooses. Not open where the
/// system has none to give.
struct Meeting {
  Descriptor socket;
  std::string name;
};
Meeting open_meeting();

/// Goes to a meeting. Not open where there is none of this name.
Descriptor join_meeting(const std::string& name);

/// The process at the other end; nothing where it is of another user.
std::optional<pid_t> process_behind(const Descriptor& connection);

/// Sends a line of text of up to 200 bytes with open files, of which both programs have the same place in the
/// file from then on. Returns whether that was possible.
bool send_files(const Descriptor& connection, const std::string& line, std::span<const int> files);

/// Text and files of a send_files().
struct ReceivedFiles {
  std::string line;
  std::vector<Descriptor> files;
};
/// Nothing where the other end has gone.
std::optional<ReceivedFiles> receive_files(const Descriptor& connection);

}  // namespace solidus::app
