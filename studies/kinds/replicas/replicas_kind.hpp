#pragma once
/// A surface whose realizations have perturbed replicas ([twins]): how often their verdicts differ, and how long the
/// motion of some of them stays together.

#include "studies/kinds/replicas/replicas.hpp"
#include "studies/kinds/surface/surface_kind.hpp"

namespace stylobate {

class ReplicasKind : public SurfaceKind {
public:
    using SurfaceKind::SurfaceKind;

    static bool fits(const Study& study) { return study.replicas.has_value(); }
    std::optional<std::string> needs_processor() const override
    {
        return "has [twins], whose pairs are followed step by step on the processor";
    }
    std::uint64_t size_of(const Shard& shard) const override;
    double row_memory(double) const override { return 50; }
    double table_bytes() const override;
    /// Kind by kind of replica: each bundle has one contact form and one precision. Pairs are followed at the end, and
    /// again if that was interrupted.
    bool plan(Rounds& rounds) override;
    void conclude() override { replicas_ = replicas_of(study_, header_, rows_, followed_); }
    void restore(const ResultReader& reader) override;
    std::vector<Table> tables() const override;
    std::string text() const override;
    void add_to(Json& json) const override;

    static constexpr std::string_view of_replicas = "a surface with perturbed replicas ([twins])";
    static constexpr PictureKind own_pictures[] = {SurfaceKind::own_pictures[0],
                                                   SurfaceKind::own_pictures[1],
                                                   {"twins", of_replicas},
                                                   {"predictability", of_replicas}};
    std::span<const PictureKind> pictures() const override { return own_pictures; }
    Picture picture(const ResultReader& reader, const std::string& results,
                    const PictureRequest& request) const override;
    std::vector<std::pair<std::string, std::string>> files(const std::string& format,
                                                           const std::string& name) const override;
    void sections(PageWriter& writer) const override;

protected:
    void take(const ResultRow& row) override;

private:
    std::vector<ReplicaRow> rows_;
    std::vector<ReplicaSeparation> followed_;
    Replicas replicas_; ///< once it is complete
};

} // namespace stylobate
