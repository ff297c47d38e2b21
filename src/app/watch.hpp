/// The report of a run that goes on, served to a browser on this machine.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

namespace solidus::app {

/// Serves the page of a results folder at http://127.0.0.1:PORT/TOKEN/ from a thread of its own. Nothing but
/// the loopback address is listened to; whoever does not know the random token, or asks under another name
/// than 127.0.0.1 or localhost, gets 404. Two things can be asked for: the page, and `stamp`, which changes
/// when there is a new page. Nothing is taken in.
class Watch {
 public:
  /// Throws InputError where no address can be had.
  explicit Watch(std::filesystem::path folder);
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  ~Watch();

  const std::string& address() const { return address_; }
  /// The run has ended: waits a few seconds for a browser that looks on to fetch the last page.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  struct Visitor {
    int connection;
    std::string request;  ///< what it has said so far
    Clock::time_point until;
  };
  void serve();
  /// Reads what a visitor says and answers a whole request; whether its connection stays open.
  bool hear(Visitor& visitor);
  void answer(int connection, const std::string& text);
  std::string reply(const std::string& request);
  void renew();
  std::string stamp() const;
  bool begun() const;

  std::filesystem::path folder_;
  std::filesystem::file_time_type since_;  ///< what is older in the folder is of an earlier run
  std::string token_, host_, address_;
  int socket_ = -1;
  std::atomic<bool> stop_ = false, ended_ = false, last_served_ = false;
  std::atomic<Clock::rep> asked_ = 0;  ///< when a browser asked last
  std::string page_, stamp_;           ///< the page that is served now, and of what; of the thread alone
  Clock::time_point made_{};
  std::chrono::duration<double> cost_{0};  ///< of making it [s]
  std::thread thread_;
};

}  // namespace solidus::app
