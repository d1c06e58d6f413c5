#pragma once
#include <carom/gas.hpp>
#include <carom/output.hpp>
#include <carom/scene.hpp>
#include <filesystem>

namespace carom::app {

/// Collects during a run what a scene's pictures show, and draws them.
class Pictures {
  public:
    /// A scene without pictures gets trajectories (a gas by events, its measures) and energy. An Error names the
    /// picture that is wrong.
    Pictures(const Scene& scene, const World& start);
    /// To be called at the start, too.
    void observe(const World& world);
    /// What was collected, for a checkpoint, and back.
    void save(Saver& to) const;
    void restore(Loader& from);
    /// An Error if what is shown up to now is not what those of a run with another end, of that plan, collected.
    void require_same_until(const World& now, const Pictures& before, const Plan& plan_before) const;
    /// Draws all pictures into a folder; returns the files.
    std::vector<std::filesystem::path> draw(const std::filesystem::path& folder, const std::string& format) const;

  private:
    struct Recorder {
        Picture picture;
        std::string file{};  ///< without ending
        std::vector<BodyId> bodies{};
        std::string part{};  ///< "20 of 101 bodies", if these are not all
        std::vector<Track> tracks{};
        std::vector<Quantity> quantities{};
        std::vector<Twin> twins{};
        std::vector<Series> series{};
        std::vector<Moment> moments{};
        std::vector<Profile> profiles{};
        Moment around{};  ///< its lines as they were last
        std::vector<Energy> energies{};
        std::vector<double> time{};
        std::optional<GasMeter> meter{};
        /// The bodies, if the scene names them.
        std::span<const BodyId> named() const { return picture.bodies.empty() ? std::span<const BodyId>() : bodies; }
    };
    Recorder prepare(const Picture& picture, const World& start) const;
    void choose_colours(const World& start);
    void choose_twins(Recorder& recorder) const;
    void record(Recorder& recorder, const World& world) const;
    Figure figure(const Recorder& recorder) const;
    Figure trajectories(const Recorder& recorder) const;
    Figure time(const Recorder& recorder) const;
    static Figure phase(const Recorder& recorder, const std::string& x_label, const std::string& y_label);
    Figure twin(const Recorder& recorder) const;

    std::string title_;
    Plan plan_;
    std::vector<Twin> twins_;
    std::map<std::string, double> parameters_;
    std::optional<Rectangle> room_;   ///< the first one with walls
    std::optional<Rectangle> space_;  ///< that, or the periodic box
    std::size_t slices_ = 0;
    std::vector<HalfPlane> walls_;
    std::vector<Recorder> recorders_;
};

}  // namespace carom::app
