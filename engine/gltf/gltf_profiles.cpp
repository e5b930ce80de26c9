// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_profiles.h"

#include "engine/gltf/data_uri.h"
#include "engine/gltf/gltf_accessor.h"
#include "engine/gltf/gltf_value.h"
#include "engine/scene/light/ies_file.h"

#include <fmt/format.h>

namespace limn {

static Result<PhotometricFile> readProfile(const tinygltf::Model& model,
                                           const tinygltf::Value& source, const std::string& folder,
                                           FileReach reach) {
    const tinygltf::Value* uri = member(source, "uri");
    if (uri && uri->IsString()) {
        const std::string text = uri->Get<std::string>();
        if (isDataUri(text)) {
            const Result<std::string> data = dataOfUri(text);
            return data ? parseIes(*data) : tl::make_unexpected(data.error());
        }
        const Result<std::string> path = fileOfUri(folder, text, reach);
        return path ? readIes(*path) : tl::make_unexpected(path.error());
    }
    const std::optional<std::size_t> view = wholeNumber(member(source, "bufferView"));
    if (!view || *view >= model.bufferViews.size())
        return fail("neither a uri nor a bufferView that exists");
    const Result<std::span<const std::uint8_t>> bytes = viewBytes(model, int(*view));
    if (!bytes)
        return tl::make_unexpected(bytes.error());
    return parseIes({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

std::vector<ProfileRef> readProfiles(const tinygltf::Model& model, const std::string& folder,
                                     FileReach reach, GltfRepairs& repairs) {
    std::vector<ProfileRef> profiles;
    const auto extension = model.extensions.find("EXT_lights_ies");
    const tinygltf::Value* lights =
        extension == model.extensions.end() ? nullptr : member(extension->second, "lights");
    for (std::size_t i = 0; lights && lights->IsArray() && i < lights->ArrayLen(); ++i) {
        const tinygltf::Value& source = lights->Get(int(i));
        const Result<PhotometricFile> file = readProfile(model, source, folder, reach);
        profiles.emplace_back();
        if (!file) {
            repairs.sentences.push_back(fmt::format(
                "EXT_lights_ies.lights[{}]: {}; its lights are left out", i, file.error().message));
            continue;
        }
        LightProfile profile = file->profile;
        const tinygltf::Value* name = member(source, "name");
        if (profile.name.empty() && name && name->IsString())
            profile.name = name->Get<std::string>();
        profiles.back() = {std::make_shared<const LightProfile>(std::move(profile))};
    }
    return profiles;
}

} // namespace limn
