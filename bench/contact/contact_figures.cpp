// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/contact/contact_figures.hpp"

#include "bench/contact/contact_rate.hpp"
#include "bench/contact/md_over_nscd.hpp"
#include "bench/contact/polygon_rate.hpp"
#include "bench/siconos/siconos_figure.hpp"

namespace turbidite::bench {

std::vector<Figure> contact_figures() {
    using Kind = Reach::Kind;
    return {
        {"contact_rate_1397",
         "contact-iterations per second, contacts with impulse only, dry column of 1397 discs",
         "1/s",
         {Kind::at_least, 1.2e8},
         contact_rate_1397},
        {"contact_rate_50000",
         "the same for 50,000 discs",
         "1/s",
         {Kind::at_least, 8e7},
         contact_rate_50000},
        {"contact_rate_spheres",
         "the same for 50,000 spheres in mid-collapse, one core",
         "1/s",
         {Kind::at_least, 7e7},
         contact_rate_spheres},
        {"grains_speedup_2_ranks",
         "wall time of a window with 100,000 spheres, 1 grains rank over 2",
         "ratio",
         {Kind::at_least, 1.5},
         grains_speedup_2_ranks},
        {"contact_cost_growth",
         "time per contact-iteration at 1e6 discs over that at 1e3",
         "ratio",
         {Kind::at_most, 1.7},
         contact_cost_growth},
        {"siconos_over_ours",
         "time of Siconos' NSGS over ours to the same error 1e-4, dry column at 2, 9 and 14 t_c",
         "ratio",
         {Kind::at_least, 8.0},
         siconos_over_ours},
        {"spheres_over_siconos",
         "time of Siconos' fastest solver over ours to the same error 1e-4, column of 544 spheres "
         "at 1, 3 and 6 t_c",
         "ratio",
         {Kind::at_least, 15.0},
         spheres_over_siconos},
        {"md_over_nscd_dry_column",
         "wall time of yade-md over yade-nscd, dry column of 1397 discs over 20 t_c",
         "ratio",
         {Kind::at_least, 2.0},
         md_over_nscd_dry_column},
        {"polygon_detections_per_second",
         "pairs of densely packed triangles tested by the narrow phase per second, one core",
         "1/s",
         {Kind::at_least, 5e6},
         polygon_detections_per_second},
    };
}

}  // namespace turbidite::bench
