#pragma once
// What --quantity asks of a run: expressions over time, as a table.

#include <carom/output.hpp>
#include <carom/scene.hpp>
#include <string>
#include <vector>

namespace carom::app {

/// The expressions as they are known in the world of the scene; an Error says which of them is none.
std::vector<Quantity> quantities_of(const Scene& scene, const World& start, const std::vector<std::string>& texts);

/// A row a frame: the time, and each quantity.
class QuantityTable {
  public:
    QuantityTable(File file, bool begun, const Scene& scene, const World& start, const std::vector<std::string>& texts,
                  const Provenance& provenance);
    void add(const World& world);
    /// The file gets its name, with how the run came out.
    void commit(const std::string& summary);
    Bookmark sync() { return csv_.file().sync(); }
    void release() { csv_.file().release(); }

  private:
    std::vector<Quantity> quantities_;
    std::vector<double> row_;  ///< storage
    Csv csv_;
};

}  // namespace carom::app
