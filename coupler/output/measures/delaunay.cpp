// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/measures/delaunay.hpp"

#include <boost/polygon/voronoi.hpp>

namespace turbidite {

std::vector<std::vector<std::size_t>> delaunay_cells(const std::vector<GridPoint>& points) {
    namespace polygon = boost::polygon;
    std::vector<polygon::point_data<std::int32_t>> sites;
    sites.reserve(points.size());
    for (const GridPoint& point : points) sites.emplace_back(point.x, point.y);
    polygon::voronoi_diagram<double> diagram;
    polygon::construct_voronoi(sites.begin(), sites.end(), &diagram);

    std::vector<std::vector<std::size_t>> cells;
    cells.reserve(diagram.num_vertices());
    for (const auto& vertex : diagram.vertices()) {
        // A vertex of the diagram is the centre of an empty circle; the cells around it are the
        // points on it.
        std::vector<std::size_t> around;
        const auto* first = vertex.incident_edge();
        const auto* edge = first;
        do {
            around.push_back(edge->cell()->source_index());
            edge = edge->rot_next();
        } while (edge != first);
        if (around.size() >= 3) cells.push_back(std::move(around));
    }
    return cells;
}

}  // namespace turbidite
