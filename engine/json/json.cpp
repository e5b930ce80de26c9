// SPDX-License-Identifier: MIT
#include "engine/json/json.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <nlohmann/json.hpp>

namespace limn {

using Library = nlohmann::ordered_json;

static const Json kNull;

Json::Json() = default;
Json::Json(Kind kind, std::uint64_t integer, double number)
    : m_kind(kind), m_integer(integer), m_number(number) {}
Json::Json(std::string value) : m_kind(Kind::String), m_text(std::move(value)) {}
Json::Json(std::string_view value) : m_kind(Kind::String), m_text(value) {}
Json::Json(const char* value) : m_kind(Kind::String), m_text(value) {}
Json::Json(const Json&) = default;
Json::Json(Json&&) noexcept = default;
Json& Json::operator=(const Json&) = default;
Json& Json::operator=(Json&&) noexcept = default;
Json::~Json() = default;

Json::Json(std::initializer_list<Json> values) {
    const bool object = std::ranges::all_of(values, [](const Json& value) {
        return value.isArray() && value.size() == 2 && value[0].isString();
    });
    m_kind = object ? Kind::Members : Kind::Array;
    if (object)
        for (const Json& value : values)
            (*this)[value[0].m_text] = value[1];
    else
        m_elements = values;
}

Json::Json(const std::map<std::string, double>& members) : m_kind(Kind::Members) {
    for (const auto& [key, value] : members)
        m_members.push_back({key, value});
}

Json Json::array(std::initializer_list<Json> values) {
    Json json;
    json.m_kind = Kind::Array;
    json.m_elements = values;
    return json;
}

Json Json::object() {
    Json json;
    json.m_kind = Kind::Members;
    return json;
}

bool Json::boolean() const {
    assert(isBoolean());
    return m_integer != 0;
}

double Json::number() const {
    assert(isNumber());
    return m_kind == Kind::Float     ? m_number
           : m_kind == Kind::Integer ? double(std::int64_t(m_integer))
                                     : double(m_integer);
}

std::uint64_t Json::integer() const {
    assert(isNumber());
    return m_kind == Kind::Float ? std::uint64_t(std::int64_t(m_number)) : m_integer;
}

const std::string& Json::text() const {
    assert(isString());
    return m_text;
}

std::size_t Json::size() const {
    return m_elements.size() + m_members.size();
}

void Json::push_back(Json value) {
    assert(isNull() || isArray());
    m_kind = Kind::Array;
    m_elements.push_back(std::move(value));
}

Json& Json::operator[](std::string_view key) {
    assert(isNull() || isObject());
    m_kind = Kind::Members;
    const auto found = std::ranges::find(m_members, key, &JsonMember::key);
    return found != m_members.end()
               ? found->value
               : m_members.emplace_back(JsonMember{std::string(key), {}}).value;
}

const Json& Json::operator[](std::string_view key) const {
    const Json* member = find(key);
    return member ? *member : kNull;
}

const Json* Json::find(std::string_view key) const {
    const auto found = std::ranges::find(m_members, key, &JsonMember::key);
    return found != m_members.end() ? &found->value : nullptr;
}

std::span<const JsonMember> Json::members() const {
    return m_members;
}

void Json::update(const Json& object) {
    for (const auto& [key, value] : object.m_members)
        (*this)[key] = value;
}

void Json::erase(std::string_view key) {
    std::erase_if(m_members, [&](const JsonMember& member) { return member.key == key; });
}

bool operator==(const Json& a, const Json& b) {
    if (a.isNumber() && b.isNumber()) {
        if (a.isFloat() || b.isFloat())
            return a.number() == b.number();
        const auto negative = [](const Json& json) {
            return json.m_kind == Json::Kind::Integer && std::int64_t(json.m_integer) < 0;
        };
        return a.m_integer == b.m_integer && negative(a) == negative(b);
    }
    const auto sameMember = [](const JsonMember& x, const JsonMember& y) {
        return x.key == y.key && x.value == y.value;
    };
    return a.m_kind == b.m_kind && a.m_integer == b.m_integer && a.m_text == b.m_text &&
           a.m_elements == b.m_elements && std::ranges::equal(a.m_members, b.m_members, sameMember);
}

/// The library's value of the same text.
static Library libraryValue(const Json& json) {
    if (json.isObject()) {
        Library object = Library::object();
        for (const auto& [key, value] : json.members())
            object[key] = libraryValue(value);
        return object;
    }
    if (json.isArray()) {
        Library array = Library::array();
        for (const Json& value : json)
            array.push_back(libraryValue(value));
        return array;
    }
    if (json.isString())
        return json.get<std::string>();
    if (json.isBoolean())
        return json.get<bool>();
    if (json.isFloat())
        return json.get<double>();
    if (const auto integer = json.integerWithin<std::int64_t>())
        return *integer;
    return json.isInteger() ? Library(json.get<std::uint64_t>()) : Library();
}

std::string Json::dump(int indent) const {
    return libraryValue(*this).dump(indent, ' ', false, Library::error_handler_t::replace);
}

namespace {

/// What the library's parser calls. Builds the value without a copy in the library's form.
class Builder {
public:
    explicit Builder(int maxDepth) : m_maxDepth(maxDepth) {}

    Result<Json> result() && {
        if (!m_problem.empty())
            return fail(m_problem);
        return std::move(m_root);
    }

    bool null() { return add(Json()); }
    bool boolean(bool value) { return add(value); }
    bool number_integer(std::int64_t value) { return add(value); }
    bool number_unsigned(std::uint64_t value) { return add(value); }
    bool number_float(double value, const std::string&) { return add(value); }
    bool string(std::string& value) { return add(std::move(value)); }
    bool binary(Library::binary_t&) { return false; } // no text has any
    bool start_object(std::size_t) { return open(Json::object()); }
    bool start_array(std::size_t) { return open(Json::array()); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(std::string& name) {
        m_key = std::move(name);
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& e) {
        const std::string_view what = e.what(); // begins with the library's number of the error
        m_problem = what.substr(std::min(what.find(']') + 2, what.size()));
        return false;
    }

private:
    Json* place(Json value) {
        if (m_open.empty()) {
            m_root = std::move(value);
            return &m_root;
        }
        Json& parent = *m_open.back();
        if (parent.isArray()) {
            parent.push_back(std::move(value));
            return &parent.back();
        }
        Json& member = parent[m_key];
        member = std::move(value);
        return &member;
    }
    bool add(Json value) {
        place(std::move(value));
        return true;
    }
    bool open(Json value) {
        if (int(m_open.size()) >= m_maxDepth) {
            m_problem = "nested too deeply";
            return false;
        }
        m_open.push_back(place(std::move(value)));
        return true;
    }
    bool close() {
        m_open.pop_back();
        return true;
    }

    int m_maxDepth;
    Json m_root;
    std::vector<Json*> m_open; ///< arrays and objects whose ends are to come, the outermost first
    std::string m_key;         ///< of the next member
    std::string m_problem;
};

} // namespace

Result<Json> parseJson(std::string_view text, int maxDepth) {
    Builder builder(maxDepth);
    Library::sax_parse(text, &builder);
    return std::move(builder).result();
}

} // namespace limn
