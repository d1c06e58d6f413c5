#pragma once
// One pass over the rows where there would be two: what one pass has in the cache, the other wants some rows before or
// after it. Memory is what a step of a large world waits for.

#include <vector>

#include "forces/parts.hpp"

namespace carom {

/// The blocks of sum_over_rows(), gone through by runs, each of them on one thread from end to end.
class Wave {
  public:
    /// `reach`: the work on a row looks at rows no farther than that from it.
    Wave(std::size_t rows, std::size_t reach, int threads) : reach_(reach), threads_(threads) {
        const Parts parts(rows);
        const std::size_t runs =
            threads > 1 ? std::min<std::size_t>(4 * static_cast<std::size_t>(threads), parts.count) : 1;
        for (std::size_t part = 0, run = 0; part < parts.count; ++part) {
            if (part == run * parts.count / runs) first_of_run_.push_back(first_.size()), ++run;
            first_of_part_.push_back(first_.size());
            for (std::size_t row = parts.begin(part); row < parts.begin(part + 1); row += rows_at_once)
                first_.push_back(row);
        }
        first_of_run_.push_back(first_.size());
        first_of_part_.push_back(first_.size());
        first_.push_back(rows);
    }

    std::size_t runs() const { return first_of_run_.size() - 1; }
    std::size_t first_of_run(std::size_t run) const { return first_[first_of_run_[run]]; }
    std::size_t blocks() const { return first_.size() - 1; }
    std::size_t first(std::size_t block) const { return first_[block]; }
    std::size_t last(std::size_t block) const { return first_[block + 1]; }

    /// For every block ahead(block), when no work has looked near it; work(block, its run), when all near it is ahead
    /// and nothing behind; and behind(block), when no work will look near it any more.
    template <class Ahead, class Work, class Behind>
    void go(const Ahead& ahead, const Work& work, const Behind& behind) const {
        std::vector<std::size_t> between;  // runs, and so within the reach of two
        for (std::size_t run = 0; run < runs(); ++run)
            for (std::size_t b = first_of_run_[run]; b < first_of_run_[run + 1]; ++b)
                if (is_between(b, run)) between.push_back(b);
        parallel_for(threads_, between.size(), [&](std::size_t k) { ahead(between[k]); });
        parallel_for(threads_, runs(), [&](std::size_t run) {
            const std::size_t end = first_of_run_[run + 1];
            std::size_t next = first_of_run_[run], done = next;
            for (std::size_t b = next; b < end; ++b) {
                for (; next < end && first(next) < last(b) + reach_; ++next)
                    if (!is_between(next, run)) ahead(next);
                work(b, run);
                for (; done < end && (b + 1 == end || last(done) + reach_ <= last(b)); ++done)
                    if (!is_between(done, run)) behind(done);
            }
        });
        parallel_for(threads_, between.size(), [&](std::size_t k) { behind(between[k]); });
    }

    /// The sum of what each block gave, in the order of sum_over_rows().
    template <class Sum>
    Sum total(const std::vector<Sum>& of_block) const {
        Sum all{};
        for (std::size_t part = 0; part + 1 < first_of_part_.size(); ++part) {
            Sum sum{};
            for (std::size_t b = first_of_part_[part]; b < first_of_part_[part + 1]; ++b) sum += of_block[b];
            all += sum;
        }
        return all;
    }

  private:
    bool is_between(std::size_t block, std::size_t run) const {
        return (run > 0 && first(block) < first(first_of_run_[run]) + reach_) ||
               (run + 1 < runs() && last(block) + reach_ > first(first_of_run_[run + 1]));
    }

    std::size_t reach_;
    int threads_;
    std::vector<std::size_t> first_, first_of_part_, first_of_run_;  ///< rows; blocks; blocks; and the ends
};

}  // namespace carom
