// SPDX-License-Identifier: MIT
#include "engine/files/document_json.h"

#include "engine/core/hash.h"
#include "engine/files/document_fields.h"
#include "engine/files/project_file.h"
#include "engine/json/json.h"
#include "engine/scene/find_object.h"
#include "engine/scene/origin.h"
#include "engine/scene/reach.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <map>
#include <optional>
#include <set>
#include <span>

#include <fmt/format.h>

namespace limn {

/// The double with the fewest digits that convert back to the same float: 0.1f becomes 0.1.
static double shortest(float value) {
    const std::string digits = fmt::format("{}", value);
    double out = double(value); // stays where it is no number
    std::from_chars(digits.data(), digits.data() + digits.size(), out);
    return out;
}

static double shortest(double value) {
    return value;
}

namespace {

/// Writes fields to a JSON object.
struct FieldWriter {
    Json& out;
    const glm::dvec3& origin; ///< of world space, in the file's coordinates

    template <class T, class... Limits>
    void operator()(const char* name, const T& value, const Limits&... limits) {
        if constexpr (std::is_enum_v<T>)
            nameOf(name, value, limits...);
        else if constexpr (std::is_floating_point_v<T>)
            out[name] = shortest(value);
        else if constexpr (std::is_integral_v<T> || std::is_same_v<T, std::string> ||
                           std::is_same_v<T, std::vector<std::uint32_t>>)
            out[name] = value;
        else if constexpr (std::is_same_v<T, std::map<std::string, double>>)
            out[name] = Json(value);
        else if constexpr (std::is_same_v<T, std::vector<float>>) {
            out[name] = Json::array();
            for (const float v : value)
                out[name].push_back(shortest(v));
        } else if constexpr (std::is_same_v<T, glm::quat>)
            for (const float v : {value.x, value.y, value.z, value.w})
                out[name].push_back(shortest(v));
        else
            for (int c = 0; c < T::length(); ++c)
                out[name].push_back(numberOf(value[c]));
    }
    void place(const char* name, glm::vec3 p) {
        if (origin == glm::dvec3(0))
            (*this)(name, p);
        else
            (*this)(name, toFile(origin, p));
    }
    template <class T>
    void unlessEmpty(const char* name, const std::vector<T>& value) {
        if (!value.empty())
            (*this)(name, value);
    }
    template <class T>
    void unless(const T& usual, const char* name, const T& value, FieldRange range) {
        if (value != usual)
            (*this)(name, value, range);
    }
    template <class T, class Describe>
    void object(const char* name, const T& value, const Describe& describe) {
        FieldWriter inner{out[name] = Json::object(), origin};
        describe(inner, value);
    }
    void profile(const char* name, const ProfileRef& value) {
        if (value)
            object(name, *value, [](auto& f, auto& p) { describeProfile(f, p); });
    }

private:
    template <class T, class Names>
    void nameOf(const char* name, T value, const Names& names) {
        out[name] = std::string(names[std::size_t(value)]);
    }
    template <class T>
    static auto numberOf(T value) {
        if constexpr (std::is_floating_point_v<T>)
            return shortest(value);
        else
            return value;
    }
};

/// Reads fields from a JSON object. After the first error, stored in `problem`, nothing more is
/// read.
class FieldReader {
public:
    FieldReader(const Json& in, std::string path, std::string& problem, const glm::dvec3& origin)
        : m_in(in), m_path(std::move(path)), m_problem(problem), m_origin(origin) {
        if (!in.isObject())
            report("", "not an object");
    }

    template <class T, class... Limits>
    void operator()(const char* name, T& value, const Limits&... limits) {
        if (const Json* json = take(name))
            read(*json, name, value, limits...);
    }
    void place(const char* name, glm::vec3& p) {
        if (const Json* json = take(name)) {
            glm::dvec3 inFile(0);
            read(*json, name, inFile);
            p = toWorld(m_origin, inFile);
        }
    }
    template <class T>
    void unlessEmpty(const char* name, std::vector<T>& value) {
        (*this)(name, value);
    }
    template <class T>
    void unless(const T& /*usual*/, const char* name, T& value, FieldRange range) {
        (*this)(name, value, range);
    }
    template <class T, class Describe>
    void object(const char* name, T& value, const Describe& describe) {
        if (const Json* json = take(name)) {
            FieldReader inner(*json, at(name), m_problem, m_origin);
            describe(inner, value);
            inner.finish();
        }
    }
    void profile(const char* name, ProfileRef& value) {
        const Json* json = take(name);
        if (!json)
            return;
        LightProfile read;
        FieldReader inner(*json, at(name), m_problem, m_origin);
        describeProfile(inner, read);
        inner.finish();
        if (const std::string defect = profileDefect(read); m_problem.empty() && !defect.empty())
            m_problem = at(name) + "." + defect;
        value = {std::make_shared<const LightProfile>(std::move(read))};
    }
    /// Reports fields of the JSON object that were not read.
    void finish() {
        if (m_problem.empty())
            for (const auto& [key, value] : m_in.members())
                if (std::ranges::find(m_known, key) == m_known.end())
                    return report(key, "unknown field");
    }

private:
    std::string at(const std::string& name) const {
        return m_path.empty() || name.empty() ? m_path + name : m_path + "." + name;
    }
    void report(const std::string& name, const std::string& reason) {
        if (m_problem.empty())
            m_problem = fmt::format("{}: {}", at(name).empty() ? "JSON" : at(name), reason);
    }
    const Json* take(const char* name) {
        m_known.emplace_back(name);
        if (!m_problem.empty() || !m_in.isObject())
            return nullptr;
        return m_in.find(name);
    }

    template <std::floating_point T>
    void read(const Json& json, const std::string& name, T& value, FieldRange range = {}) {
        if (!json.isNumber() || !std::isfinite(float(json.get<double>())))
            return report(name, "not a number");
        value = T(json.get<double>());
        checkRange(name, double(value), range);
    }
    template <class T>
    requires std::is_same_v<T, std::uint32_t> || std::is_same_v<T, std::int32_t>
    void read(const Json& json, const std::string& name, T& value, FieldRange range = {}) {
        const std::optional<T> integer = json.integerWithin<T>();
        if (!integer)
            return report(name, std::is_signed_v<T> ? "not an integer" : "not an integer >= 0");
        value = *integer;
        checkRange(name, double(value), range);
    }
    void read(const Json& json, const std::string& name, bool& value) {
        if (!json.isBoolean())
            return report(name, "not true or false");
        value = json.get<bool>();
    }
    void read(const Json& json, const std::string& name, std::string& value) {
        if (!json.isString())
            return report(name, "not a string");
        value = json.get<std::string>();
    }
    template <class T>
    requires std::is_enum_v<T>
    void read(const Json& json, const std::string& name, T& value,
              std::span<const std::string_view> names) {
        const std::string text = json.isString() ? json.get<std::string>() : "";
        const auto found = std::ranges::find(names, text);
        if (found == names.end())
            return report(name, fmt::format("not one of {}", fmt::join(names, ", ")));
        value = T(found - names.begin());
    }
    void read(const Json& json, const std::string& name, std::vector<std::uint32_t>& value) {
        if (!json.isArray())
            return report(name, "not an array");
        value.assign(json.size(), 0);
        for (std::size_t i = 0; i < json.size() && m_problem.empty(); ++i)
            read(json[i], fmt::format("{}[{}]", name, i), value[i]);
    }
    void read(const Json& json, const std::string& name, std::vector<float>& value) {
        if (!json.isArray() || json.size() > std::size_t(kMaxProfileRows) * kMaxProfileColumns)
            return report(name, "not an array of few enough numbers");
        value.assign(json.size(), 0);
        for (std::size_t i = 0; i < json.size() && m_problem.empty(); ++i)
            read(json[i], fmt::format("{}[{}]", name, i), value[i]);
    }
    void read(const Json& json, const std::string& name, std::map<std::string, double>& value) {
        if (!json.isObject())
            return report(name, "not an object");
        value.clear();
        for (const auto& [key, number] : json.members()) {
            double& to = value[key];
            read(number, name + "." + key, to);
        }
    }
    /// Reads vectors and quaternions; the latter as x, y, z, w.
    template <class V>
    requires requires { V::length(); }
    void read(const Json& json, const std::string& name, V& value, FieldRange range = {}) {
        if (!json.isArray() || json.size() != std::size_t(V::length()))
            return report(name, fmt::format("not {} numbers", int(V::length())));
        for (int c = 0; c < V::length() && m_problem.empty(); ++c) {
            typename V::value_type number{};
            read(json[std::size_t(c)], fmt::format("{}[{}]", name, c), number, range);
            if constexpr (std::is_same_v<V, glm::quat>)
                (c == 0 ? value.x : c == 1 ? value.y : c == 2 ? value.z : value.w) = number;
            else
                value[c] = number;
        }
    }
    void checkRange(const std::string& name, double value, FieldRange range) {
        if (value < range.lower)
            report(name, fmt::format("less than {}", range.lower));
        else if (value > range.upper)
            report(name, fmt::format("more than {}", range.upper));
    }

    const Json& m_in;
    std::string m_path;
    std::string& m_problem;
    const glm::dvec3& m_origin;
    std::vector<std::string> m_known;
};

} // namespace

static bool isUnit(double squaredLength) {
    return std::abs(squaredLength - 1) < 2e-3;
}

template <class V>
static bool isUnitVector(const V& v) {
    double sum = 0;
    for (int c = 0; c < V::length(); ++c)
        sum += double(v[c]) * double(v[c]);
    return isUnit(sum);
}

/// Checks conditions that involve several fields of an object.
static std::string invariantOf(const Object& object) {
    if (const Node* node = std::get_if<Node>(&object)) {
        if (!isUnitVector(node->transform.rotation))
            return ".transform.rotation: not of unit length";
        for (int c = 0; c < 3; ++c)
            if (node->transform.scale[c] == 0)
                return fmt::format(".transform.scale[{}]: may not be 0", c);
    } else if (const Light* light = std::get_if<Light>(&object)) {
        if (!isUnitVector(light->direction))
            return ".direction: not of unit length";
        if (light->kind == LightKind::Spot && !(light->innerAngle < light->outerAngle))
            return ".innerAngle: not less than outerAngle";
    } else if (const Camera* camera = std::get_if<Camera>(&object)) {
        if (!isUnitVector(camera->up))
            return ".up: not of unit length";
        if (camera->eye == camera->target)
            return ".target: may not be the eye";
    } else if (const auto* settings = std::get_if<ExportSettings>(&object)) {
        if (const std::string defect = settingsDefect(*settings); !defect.empty())
            return ": " + defect;
    }
    return {};
}

/// Reads the object from the field that names its kind.
static Result<Object> readObject(const Json& json, const std::string& path,
                                 const glm::dvec3& origin) {
    static const std::array<Object, 9> kinds = {
        Node{},         Material{},        Light{},           Camera{},        Sky{},
        BakeSettings{}, TechniqueChoice{}, RelightSettings{}, ExportSettings{}};
    Result<Object> result = fail(path + ": no node, material, light, camera, sky, bakeSettings, "
                                        "technique, relighting or export");
    for (const Object& kind : kinds)
        describeObject(kind, [&](const char* name, auto object, const auto& describe) {
            const Json* found = json.find(name);
            if (!found || (!result && result.error().message.starts_with(path + ".")))
                return;
            std::string problem;
            FieldReader fields(*found, path + "." + name, problem, origin);
            describe(fields, object);
            fields.finish();
            if (problem.empty()) {
                result = object;
                if (const std::string broken = invariantOf(*result); !broken.empty())
                    problem = path + "." + name + broken;
            }
            if (!problem.empty())
                result = fail(problem);
        });
    return result;
}

/// Reads the settings of relighting that older projects keep among the bake's, where two of them
/// had these names, and removes them from there. Returns std::nullopt where there are none.
static Result<std::optional<RelightSettings>>
takeFormerRelightSettings(Json& bakeSettings, const std::string& path, const glm::dvec3& origin) {
    Json taken = Json::object();
    for (const char* key : {"maxBounces", "dimming"})
        if (const Json* setting = bakeSettings.find(key)) {
            taken[key] = *setting;
            bakeSettings.erase(key);
        }
    if (taken.empty())
        return std::nullopt;
    RelightSettings settings;
    std::string problem;
    FieldReader fields(taken, path, problem, origin);
    visitRelightSettings(settings, [&](const Setting& setting, auto& value, const auto&... limits) {
        const bool renamed = std::string_view(setting.key) == "dynamicOcclusion";
        fields(renamed ? "dimming" : setting.key, value, fieldLimits(limits)...);
    });
    if (!problem.empty())
        return fail(problem);
    return settings;
}

static Result<void> readEntry(const Json& json, const std::string& path, Document& document) {
    if (!json.isObject())
        return fail(path + ": not an object");
    const std::optional<ObjectId> id = json["id"].integerWithin<ObjectId>();
    if (!id || *id == 0 || *id == ~ObjectId(0))
        return fail(path + ".id: not a positive integer");
    Result<Object> object = readObject(json, path, document.origin);
    if (!object)
        return tl::make_unexpected(object.error());
    if (json.size() != 2) {
        const auto known = [&](const std::string& key) {
            bool same = key == "id";
            describeObject(*object, [&](const char* name, const auto&, const auto&) {
                same = same || key == name;
            });
            return same;
        };
        for (const auto& [key, value] : json.members())
            if (!known(key))
                return fail(fmt::format("{}.{}: unknown field", path, key));
    }
    if (!document.objects.emplace(*id, std::move(*object)).second)
        return fail(fmt::format("{}.id: {} is there twice", path, *id));
    return {};
}

/// Checks that parents exist, are nodes, and lead to a root.
static Result<void> checkTree(const Document& document) {
    std::map<ObjectId, ObjectId> walk; // node -> the walk that met it first
    for (const auto& [id, object] : document.objects) {
        ObjectId ancestor = id;
        while (ancestor != 0) {
            const Node* node = findObjectAs<Node>(document, ancestor);
            if (!node && ancestor == id)
                break; // not a node
            if (!node)
                return fail(fmt::format("object {}.node.parent: {} is no node", id, ancestor));
            const auto [met, first] = walk.emplace(ancestor, id);
            if (!first && met->second == id)
                return fail(
                    fmt::format("object {}.node.parent: the node is its own ancestor", ancestor));
            if (!first)
                break;
            ancestor = node->parent;
        }
    }
    return {};
}

static Result<void> checkVersion(const Json& json) {
    const Json* version = json.find("version");
    if (!version)
        return fail("version: missing; this is no Limn project");
    if (!version->isInteger())
        return fail("version: not an integer");
    if (*version != kProjectVersion)
        return fail(fmt::format("version: {} is unknown, this Limn reads {}", version->dump(),
                                kProjectVersion));
    return {};
}

static Result<void> readHead(const Json& json, Document& document) {
    std::string problem, hash = hexHash(0);
    std::int32_t version = 0;
    std::uint32_t nextId = 0;
    {
        Json rest = Json::object();
        for (const auto& [key, value] : json.members())
            if (key != "objects" && key != "files")
                rest[key] = value;
        FieldReader fields(rest, "", problem, document.origin);
        fields("version", version);
        fields("scene", document.scenePath);
        fields("sceneHash", hash);
        fields("nextId", nextId);
        fields("origin", document.origin, FieldRange{-kMaxCoordinate, kMaxCoordinate});
        fields.finish();
    }
    if (!problem.empty())
        return fail(problem);
    const auto [end, error] =
        std::from_chars(hash.data(), hash.data() + hash.size(), document.sceneHash, 16);
    if (error != std::errc() || end != hash.data() + hash.size() || hash.size() != 16)
        return fail("sceneHash: not 16 hexadecimal digits");
    document.nextId = std::max<ObjectId>(nextId, 1);
    return {};
}

static Result<void> readFiles(const Json& json, Document& document) {
    const Json* files = json.find("files");
    if (!files)
        return {};
    if (!files->isArray())
        return fail("files: not an array");
    for (std::size_t i = 0; i < files->size(); ++i) {
        std::string problem;
        FieldReader fields((*files)[i], fmt::format("files[{}]", i), problem, document.origin);
        describeAssetFile(fields, document.files.emplace_back());
        fields.finish();
        if (problem.empty() && document.files.back().path.empty())
            problem = fmt::format("files[{}].path: empty", i);
        if (!problem.empty())
            return fail(problem);
    }
    return {};
}

static Result<ProjectText> readProject(Json json) {
    if (!json.isObject())
        return fail("JSON: not an object");
    if (Result<void> version = checkVersion(json); !version)
        return tl::make_unexpected(version.error());
    ProjectText project;
    if (Result<void> head = readHead(json, project.document); !head)
        return tl::make_unexpected(head.error());
    if (Result<void> files = readFiles(json, project.document); !files)
        return tl::make_unexpected(files.error());
    project.hasObjects = json.contains("objects");
    if (!project.hasObjects)
        return project;
    Json& objects = json["objects"];
    if (!objects.isArray())
        return fail("objects: not an array");
    std::optional<RelightSettings> former;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        Json& entry = objects[i];
        const std::string path = fmt::format("objects[{}]", i);
        if (entry.isObject() && entry.contains("bakeSettings")) {
            auto taken = takeFormerRelightSettings(entry["bakeSettings"], path + ".bakeSettings",
                                                   project.document.origin);
            if (!taken)
                return tl::make_unexpected(taken.error());
            if (*taken)
                former = *taken;
        }
        if (Result<void> read = readEntry(entry, path, project.document); !read)
            return tl::make_unexpected(read.error());
    }
    if (!project.document.objects.empty()) {
        const ObjectId last = project.document.objects.rbegin()->first;
        if (!json.contains("nextId"))
            project.document.nextId = last + 1;
        if (project.document.nextId <= last)
            return fail(fmt::format("nextId: object {} exists", last));
    }
    const bool hasRelighting = std::ranges::any_of(project.document.objects, [](const auto& entry) {
        return std::holds_alternative<RelightSettings>(entry.second);
    });
    if (former && !hasRelighting)
        addObject(project.document, *former);
    if (Result<void> tree = checkTree(project.document); !tree)
        return tl::make_unexpected(tree.error());
    return project;
}

Result<ProjectText> readProjectText(const std::string& json) {
    constexpr int kMaxDepth = 16; // deeper than any project
    Result<Json> parsed = parseJson(json, kMaxDepth);
    return parsed ? readProject(std::move(*parsed)) : fail("JSON: " + parsed.error().message);
}

std::string documentToJson(const Document& document) {
    Json json;
    json["version"] = kProjectVersion;
    json["scene"] = document.scenePath;
    json["sceneHash"] = hexHash(document.sceneHash);
    json["nextId"] = document.nextId;
    if (document.origin != glm::dvec3(0))
        json["origin"] = {document.origin.x, document.origin.y, document.origin.z};
    for (const AssetFile& file : document.files) {
        json["files"].push_back(Json::object());
        FieldWriter fields{json["files"].back(), document.origin};
        describeAssetFile(fields, file);
    }
    json["objects"] = Json::array();
    for (const auto& [id, object] : document.objects) {
        Json entry;
        entry["id"] = id;
        describeObject(object, [&](const char* name, const auto& value, const auto& describe) {
            FieldWriter fields{entry[name] = Json::object(), document.origin};
            describe(fields, value);
        });
        json["objects"].push_back(std::move(entry));
    }
    return json.dump(1) + "\n";
}

Result<Document> documentFromJson(const std::string& json) {
    Result<ProjectText> project = readProjectText(json);
    if (!project)
        return tl::make_unexpected(project.error());
    return std::move(project->document);
}

} // namespace limn
