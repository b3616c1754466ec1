// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/walls/space_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "coupler/rigid/vec3.hpp"
#include "coupler/shapes/wall_surface.hpp"
#include "launcher/case/files/csv_table.hpp"

namespace turbidite {
namespace {

constexpr double right_angle = 1e-9;  // largest cosine

/// A vector of a wall and the columns of its parts.
struct VectorColumns {
    const char* names[3];
    Vec3 SpaceForm::*value;
    bool needed;
};
constexpr VectorColumns vector_columns[] = {
    {{"x", "y", "z"}, &SpaceForm::place, true},
    {{"ax", "ay", "az"}, &SpaceForm::a, true},
    {{"bx", "by", "bz"}, &SpaceForm::b, false},
    {{"vx", "vy", "vz"}, &SpaceForm::velocity, false},
    {{"wx", "wy", "wz"}, &SpaceForm::spin, false},
    {{"px", "py", "pz"}, &SpaceForm::pivot, false},
};

const CsvForm& space_csv_form() {
    static const CsvForm form = {
        {"id", "kind", "x",  "y",  "z",         "ax",       "ay",       "az",    "bx",
         "by", "bz",   "r1", "r2", "vx",        "vy",       "vz",       "wx",    "wy",
         "wz", "px",   "py", "pz", "thickness", "friction", "material", "motion"},
        {"id", "kind", "x", "y", "z", "ax", "ay", "az"},
        "In space the first line must read id,kind,x,y,z,ax,ay,az[,bx,by,bz][,r1][,r2]"
        "[,thickness][,vx,vy,vz][,wx,wy,wz][,px,py,pz][,friction][,material][,motion]; "
        "lengths in D, velocities in u_c, spins in 1/t_c.",
        "wall"};
    return form;
}

const char* name_of(SpaceWallKind kind) {
    for (const SpaceWallName& entry : space_wall_names())
        if (entry.kind == kind) return entry.name;
    return "";
}

std::string all_kinds() {
    std::string names;
    for (const SpaceWallName& entry : space_wall_names())
        names += (names.empty() ? "" : ", ") + std::string(entry.name);
    return names;
}

/// One line of the table, by column.
class Fields {
 public:
    Fields(CsvTable& table, const CsvTable::Row& row) : table_(table), line_(row.line) {
        for (std::size_t i = 0; i < table.columns.size(); ++i)
            fields_[table.columns[i]] = row.fields[i];
    }

    std::string text(const std::string& column) const {
        const auto at = fields_.find(column);
        return at == fields_.end() ? "" : at->second;
    }
    bool gives(const std::string& column) const { return !text(column).empty(); }
    double number(const std::string& column) {
        return finite_number(table_, line_, column, text(column), "Give a number.").value_or(0.0);
    }
    GrainId id() { return whole_number(table_, line_, "id", text("id")).value_or(0); }
    void refuse(const std::string& fault, const std::string& allowed, const std::string& remedy) {
        table_.refuse(line_, fmt::format("wall {}: {}", text("id"), fault), allowed, remedy);
    }

 private:
    CsvTable& table_;
    int line_;
    std::map<std::string, std::string> fields_;
};

void read_kind(Fields& fields, SpaceForm& form) {
    for (const SpaceWallName& entry : space_wall_names())
        if (fields.text("kind") == entry.name) {
            form.kind = entry.kind;
            return;
        }
    fields.refuse("kind = " + fields.text("kind"), "A wall is one of " + all_kinds() + ".",
                  "Use one of these.");
}

void read_vectors(Fields& fields, SpaceForm& form) {
    for (const VectorColumns& vector : vector_columns) {
        const auto gives = [&](const char* name) { return fields.gives(name); };
        const auto given = std::count_if(vector.names, vector.names + 3, gives);
        if (given == 0 && !vector.needed) continue;
        if (given < 3) {
            fields.refuse(fmt::format("of {}, {}, {} not all are given", vector.names[0],
                                      vector.names[1], vector.names[2]),
                          "A vector has three components.", "Give the others.");
            continue;
        }
        for (std::size_t i = 0; i < 3; ++i)
            (form.*vector.value)[i] = fields.number(vector.names[i]);
    }
}

/// Radii that the kind has are given, and others are not.
void read_radii(Fields& fields, SpaceForm& form) {
    const struct {
        const char* column;
        double& value;
        bool needed;
    } radii[] = {
        {"r1", form.radius, form.kind != SpaceWallKind::plate},
        {"r2", form.radius2, form.kind == SpaceWallKind::cone || form.kind == SpaceWallKind::ring}};
    for (const auto& [column, value, needed] : radii) {
        if (fields.gives(column) != needed)
            fields.refuse(
                fmt::format("{} is {}", column, needed ? "missing" : "given"),
                "A cylinder has a radius r1; a cone r1 and r2; a ring a hole r1 and an edge r2; a "
                "plate none.",
                needed ? "Give it." : "Leave it empty.");
        else if (needed)
            value = fields.number(column);
    }
}

void check_edges(Fields& fields, const SpaceForm& form) {
    if (!(norm(form.a) > shortest_wall))
        return fields.refuse("ax, ay, az have length 0",
                             "They are the axis of a round wall, or an edge of a plate.",
                             "Give its direction and length.");
    if (form.kind != SpaceWallKind::plate) return;
    const double length = norm(form.b);
    // cos(a, b) = a . b/(|a| |b|)
    if (!(length > shortest_wall) ||
        std::abs(dot(form.a, form.b)) > right_angle * norm(form.a) * length)
        fields.refuse("the edges a and b are not those of a rectangle",
                      "bx, by, bz must be longer than 0 and at a right angle to ax, ay, az.",
                      "Correct them.");
}

void check_radii(Fields& fields, const SpaceForm& form) {
    const double r1 = form.radius, r2 = form.radius2;
    bool fits = true;
    switch (form.kind) {
        case SpaceWallKind::plate:
            return;
        case SpaceWallKind::cylinder:
            fits = r1 > shortest_wall;
            break;
        case SpaceWallKind::cone:
            fits = std::min(r1, r2) >= 0.0 && r1 + r2 > shortest_wall;
            break;
        case SpaceWallKind::ring:
            fits = r1 >= 0.0 && r2 > r1 + shortest_wall;
            break;
    }
    if (!fits)
        fields.refuse(fmt::format("r1 = {}, r2 = {} of a {}", r1, r2, name_of(form.kind)),
                      "Radii are zero or positive; that of a cylinder and one of a cone are above "
                      "0, and the edge of a ring lies outside its hole.",
                      "Correct them.");
}

void check_surface(Fields& fields, const InnerWall& wall,
                   const std::vector<std::string>& materials) {
    if (!(wall.thickness >= 0.0))
        fields.refuse(fmt::format("thickness = {}", wall.thickness),
                      "A thickness must be zero or positive.", "Use 0 for a thin wall.");
    if (wall.friction && !(*wall.friction >= 0.0))
        fields.refuse(fmt::format("friction = {}", *wall.friction),
                      "A friction coefficient must be zero or positive.",
                      "Use 0 for a smooth wall.");
    const std::string& material = wall.space->material;
    if (material.empty()) return;
    if (std::find(materials.begin(), materials.end(), material) == materials.end())
        fields.refuse("material = " + material,
                      fmt::format("There are {}.", fmt::join(materials, ", ")),
                      "Describe it below contact.materials, or correct the name.");
    if (wall.friction)
        fields.refuse("it has a material and a friction",
                      "The friction of a material is that of contact.materials and contact.pairs.",
                      "Leave one of them empty.");
}

Vec3 usual_pivot(const SpaceForm& form) {
    return form.kind == SpaceWallKind::plate ? middle_of(form) : form.place;
}

InnerWall wall_of(CsvTable& table, const CsvTable::Row& row,
                  const std::vector<std::string>& materials) {
    const std::size_t before = table.problems.size();
    Fields fields(table, row);
    InnerWall wall;
    wall.id = fields.id();
    SpaceForm& form = wall.space.emplace();
    read_kind(fields, form);
    read_vectors(fields, form);
    if (!fields.gives("px")) form.pivot = usual_pivot(form);
    read_radii(fields, form);
    if (fields.gives("thickness")) wall.thickness = fields.number("thickness");
    if (fields.gives("friction")) wall.friction = fields.number("friction");
    form.material = fields.text("material");
    wall.motion = fields.text("motion");
    if (table.problems.size() > before) return wall;
    check_edges(fields, form);
    check_radii(fields, form);
    check_surface(fields, wall, materials);
    return wall;
}

std::string vector_text(const Vec3& x, const char* between) {
    return fmt::format("{}{}{}{}{}", x[0], between, x[1], between, x[2]);
}

bool has_second_radius(SpaceWallKind kind) {
    return kind == SpaceWallKind::cone || kind == SpaceWallKind::ring;
}

Vec3 size_of_plate(const SpaceForm& form, double thickness) {
    const Vec3 across = cross(form.a, form.b);
    Vec3 size{};
    for (std::size_t i = 0; i < 3; ++i)
        // A parallelogram: edges along an axis add up, whatever their directions; its faces are t/2
        // from it along the normal.
        size[i] = std::abs(form.a[i]) + std::abs(form.b[i]) +
                  thickness * std::abs(across[i]) / norm(across);
    return size;
}

Vec3 size_of_round(const SpaceForm& form, double thickness) {
    const Vec3 axis = form.a / norm(form.a);
    const double widest = std::max(form.radius, form.radius2);
    const double along = form.kind == SpaceWallKind::ring ? 0.0 : norm(form.a);
    const double wider = has_second_radius(form.kind) ? form.radius2 - form.radius : 0.0;
    // The normal of the meridian (wider, along) is (along, -wider)/slant beside the axis.
    const double slant = std::hypot(along, wider);
    Vec3 size{};
    for (std::size_t i = 0; i < 3; ++i) {
        // A circle normal to the unit vector e extends by R sqrt(1 - e_i^2) along axis i.
        const double circle = std::sqrt(std::max(0.0, 1.0 - axis[i] * axis[i]));
        const double faces = along / slant * circle + std::abs(wider) / slant * std::abs(axis[i]);
        size[i] = along * std::abs(axis[i]) + 2.0 * widest * circle + thickness * faces;
    }
    return size;
}

}  // namespace

InnerWalls read_space_walls_csv(const std::filesystem::path& file,
                                const std::vector<std::string>& materials) {
    CsvTable table = read_csv(file, space_csv_form());
    InnerWalls result;
    std::map<GrainId, int> first;
    for (const CsvTable::Row& row : table.rows) {
        const InnerWall wall = wall_of(table, row, materials);
        if (const auto [at, fresh] = first.emplace(wall.id, row.line); !fresh)
            table.refuse(row.line, fmt::format("wall id {} is given twice", wall.id),
                         fmt::format("It is already in line {}.", at->second),
                         "Renumber one of them.");
        result.walls.push_back(wall);
    }
    result.problems = std::move(table.problems);
    return result;
}

std::string space_walls_csv(const std::vector<InnerWall>& walls) {
    std::string text =
        "id,kind,x,y,z,ax,ay,az,bx,by,bz,r1,r2,thickness,vx,vy,vz,wx,wy,wz,px,py,pz,friction,"
        "material,motion\n";
    for (const InnerWall& wall : walls) {
        const SpaceForm& form = *wall.space;
        const bool plate = form.kind == SpaceWallKind::plate;
        text += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", wall.id, name_of(form.kind),
            vector_text(form.place, ","), vector_text(form.a, ","),
            plate ? vector_text(form.b, ",") : ",,", plate ? "" : fmt::format("{}", form.radius),
            has_second_radius(form.kind) ? fmt::format("{}", form.radius2) : "", wall.thickness,
            vector_text(form.velocity, ","), vector_text(form.spin, ","),
            vector_text(form.pivot, ","), wall.friction ? fmt::format("{}", *wall.friction) : "",
            form.material, wall.motion);
    }
    return text;
}

double surface_gap(const InnerWall& wall, const Vec3& place, double radius) {
    // Distances have no sign: walls hold grains on both sides.
    return distance(surface_of(*wall.space), place) - radius - 0.5 * wall.thickness;
}

Vec3 middle_of(const SpaceForm& form) {
    if (form.kind == SpaceWallKind::plate) return form.place + 0.5 * (form.a + form.b);
    return form.kind == SpaceWallKind::ring ? form.place : form.place + 0.5 * form.a;
}

Vec3 size_of(const InnerWall& wall) {
    const SpaceForm& form = *wall.space;
    return form.kind == SpaceWallKind::plate ? size_of_plate(form, wall.thickness)
                                             : size_of_round(form, wall.thickness);
}

std::string space_walls_setting(const std::vector<InnerWall>& walls, const Scales& scales,
                                double friction, const std::vector<std::string>& materials) {
    const double d = scales.diameter;
    const auto in_metres = [d](const Vec3& x) { return vector_text(d * x, " "); };
    std::string text;
    for (const InnerWall& wall : walls) {
        const SpaceForm& form = *wall.space;
        const auto at = std::find(materials.begin(), materials.end(), form.material);
        // -1: no material of its own, but `friction` (space_walls.hpp).
        const auto material = at == materials.end() ? -1 : at - materials.begin();
        text += fmt::format("{}{} {} {} {} {} {} {} {} {} {} {} {} {}", text.empty() ? "" : ";",
                            wall.id, name_of(form.kind), in_metres(form.place), in_metres(form.a),
                            in_metres(form.b), form.radius * d, form.radius2 * d,
                            wall.thickness * d, vector_text(scales.velocity * form.velocity, " "),
                            vector_text(form.spin / scales.time, " "), in_metres(form.pivot),
                            wall.friction.value_or(friction), material);
    }
    return text;
}

}  // namespace turbidite
