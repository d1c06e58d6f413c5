#pragma once
// Runs that go on after they were killed, or came to their end.

#include <chrono>
#include <optional>

#include "products.hpp"

namespace carom::app {

/// What `--checkpoint every=60s,file=gas.checkpoint,keep` asks for. Paths become absolute: the run may go on elsewhere.
void prepare_checkpoints(const std::string& text, const std::string& label, Products& products);

/// A run as its checkpoint has it.
struct Resumed {
    Scene scene;
    std::string label;
    Products products;
    std::string state;  ///< for perform()
};
Resumed resume(const std::string& file);

/// Writes checkpoints of a run.
class Checkpoints {
  public:
    /// An Error if they would replace what another process writes, or what another run can go on from.
    Checkpoints(const Scene& scene, const std::string& label, const Products& products, Provenance provenance);
    /// Whether it is time for one.
    bool due(std::uint64_t steps_done);
    void write(const std::function<void(Saver&)>& save_state);
    /// An Error that ends the run, and how the run goes on if it can: when a full disk has room again, say.
    Error with_way_on(const Error& error) const;
    /// The run is at its end, and nothing can be resumed.
    void remove() const;

  private:
    using Clock = std::chrono::steady_clock;
    std::string scene_file_, label_;
    Products products_;
    Provenance provenance_;
    Clock::time_point last_ = Clock::now();
    std::optional<CheckpointClaim> claim_;
    bool any_;  ///< whether there is one of this run, and no older one's
};

}  // namespace carom::app
