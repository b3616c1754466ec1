// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE's own engines as a host of molecular dynamics: spheres, in the plane with the mass and
// inertia of discs and restricted to it, ViscElMat contacts (linear spring and dashpot, no
// attraction, Coulomb friction), NewtonIntegrator without numerical damping. The Python object
// `scene` (md_scene.py) contains them; forces and motions are read here.
#pragma once

#include <boost/python/object.hpp>
#include <string>
#include <vector>

#include "granular_adapter/grains/borders.hpp"
#include "granular_adapter/md/md_host.hpp"
#include "granular_adapter/yade/bodies/body_exchange.hpp"

namespace turbidite::yade {

class YadeMdHost final : public MdHost {
 public:
    /// `scene` has create(settings, grains), which returns body ids; states(bodies); erase(bodies);
    /// complete(), called when all bodies exist; begin_window(), called before the sub-steps of
    /// each window; step(), one sub-step; contacts(); touching(); deepest_overlap(known); save()
    /// and restore(bytes).
    YadeMdHost(boost::python::object scene, std::string yade_version);

    std::string code() const override { return "YADE " + version_; }
    std::int32_t dimension() const override { return both_dimensions; }
    std::vector<std::string> shapes() const override { return {"disc", "sphere"}; }
    void create(const Settings& settings, const ShapeTable& shapes,
                const nscd::Bodies& bodies) override;
    void read(nscd::Bodies& bodies) const override;
    void write(const nscd::Bodies& bodies) override;
    SubstepReport run(const Substeps& substeps, const std::vector<Load>& loads) override;
    void keep(const std::vector<std::uint8_t>& mask) override;
    SavedState save() const override;
    void restore(const SavedState& state) override;

 private:
    void fetch_bodies(std::size_t grains);
    void set_loads(const std::vector<Load>& loads);
    std::vector<ContactRecord> touching(double window) const;
    double deepest_overlap(double known) const;
    void add_forces(SubstepReport& report, double step) const;

    boost::python::object scene_;
    std::string version_;
    std::vector<int> ids_;  ///< ids of YADE's bodies, in the order of the grains
    BodyExchange exchange_;
    std::vector<double> radii_;
    std::vector<Border> borders_;
    std::int64_t stride_ = 1;  ///< sub-steps between two probes for overlaps
    bool in_space_ = false;
    bool loaded_ = false;  ///< YADE still holds forces of an earlier window
};

}  // namespace turbidite::yade
