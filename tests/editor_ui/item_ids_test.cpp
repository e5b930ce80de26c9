// SPDX-License-Identifier: MIT
// That no two widgets of a frame share an id, wherever one clicks.
#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/object_rules.h"
#include "editor_ui/panels/action.h"
#include "engine/lint/lint.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/baked_editor.h"
#include "tests/editor_ui/drawn_items.h"

#include <algorithm>
#include <deque>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace limn::item_ids_test {
namespace {

struct Click {
    ImGuiID id = 0;
    int button = 0;

    auto operator<=>(const Click&) const = default;
};

bool isInPopup(const DrawnItem& item) {
    for (const ImGuiWindow* window = item.window; window; window = window->ParentWindow)
        if (window->Flags & (ImGuiWindowFlags_Popup | ImGuiWindowFlags_Modal))
            return true;
    return false;
}

/// Someone who clicks every widget of an editor, and every widget of what opens then.
struct Visitor {
    HeadlessUi ui{1600, 1800};
    DrawnItems drawn;
    EditorState state;
    std::set<Click> tried;
    std::size_t hits = 0, clicks = 0;

    void frames(int count) {
        for (int i = 0; i < count; ++i)
            ui.frames(state);
    }

    /// As the editor is before the first click.
    void restart(const EditorState& start) {
        state = start;
        ImGui::ClosePopupsOverWindow(nullptr, false);
        ImGui::ClearActiveID();
        for (ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
            window->StateStorage.Clear(); // tree nodes
        ui.mouse(-1000, -1000);
        frames(3);
    }

    /// Where the widget is seen; empty: nowhere.
    static ImRect seen(const DrawnItem& item) {
        ImRect box = item.box;
        box.ClipWith(item.window->OuterRectClipped);
        return box;
    }

    void click(const Click& wanted) {
        const DrawnItem* item = drawn.find(wanted.id);
        if (!item)
            return;
        const ImVec2 middle = seen(*item).GetCenter();
        ui.mouse(middle.x, middle.y);
        frames(2);
        ++clicks;
        hits += ImGui::GetCurrentContext()->HoveredId == wanted.id;
        ui.button(true, wanted.button);
        ui.button(false, wanted.button);
        frames(3);
    }

    /// Widgets that were not clicked yet.
    std::vector<Click> newWidgets(bool popupsAlone) {
        std::vector<Click> found;
        for (const DrawnItem& item : drawn.lastFrame()) {
            const ImRect box = seen(item);
            if (box.GetWidth() < 1 || box.GetHeight() < 1 || (popupsAlone && !isInPopup(item)))
                continue;
            const bool row = std::string(item.window->Name).starts_with("outliner/");
            for (int button = 0; button < (row ? 2 : 1); ++button)
                if (tried.insert({item.id, button}).second)
                    found.push_back({item.id, button});
        }
        return found;
    }

    void clickEverything(const EditorState& start) {
        constexpr std::size_t kMaxClicks = 4; // "File", "Export light", a list of it, an entry
        restart(start);
        std::deque<std::vector<Click>> paths;
        for (const Click& first : newWidgets(false))
            paths.push_back({first});
        for (; !paths.empty(); paths.pop_front()) {
            restart(start);
            for (const Click& next : paths.front())
                click(next);
            if (paths.front().size() == kMaxClicks)
                continue;
            for (const Click& next : newWidgets(true)) {
                paths.push_back(paths.front());
                paths.back().push_back(next);
            }
        }
    }

    void expectNoCollisions() const {
        for (const std::string& collision : drawn.collisions())
            ADD_FAILURE() << collision;
    }
};

/// A document with a file beside it, with names that repeat and names that ImGui's ids could be
/// mistaken for, and with something in every panel.
EditorState crowdedEditor(const TemporaryFolder& folder) {
    EditorState state = BakedEditor().state;
    Assets assets = *state.assets;
    assets.images.push_back({.name = "Film", .width = 1, .height = 1, .rgba = {0, 0, 0, 255}});
    state.assets = std::make_shared<const Assets>(std::move(assets));
    Material film;
    film.name = "Stone";
    for (const TextureSlot slot : kTextureSlots)
        textureIn(film, slot).image = 0;
    addObject(state.document, film);
    for (const char* name : {"", "Lamp", "Lamp", "##row", "Lamp###row"})
        addObject(state.document, Light{.name = name});
    addObject(state.document, TechniqueChoice{});
    for (auto& [id, object] : state.document.objects)
        if (auto* node = std::get_if<Node>(&object))
            node->name = "Left";
    for (const char* name : {"a.limn", "b.gltf", "b.png", "b.hdr", "b.exr"})
        std::ofstream(folder.file(name)) << "";
    state.projectPath = folder.file("a.limn");
    state.recent = {"/one/house.limn", "/two/house.limn", "/house.limn##two"};
    state.samples = {"atrium", "cornell"};
    state.log.assign(3, {LogLine::Level::Warning, "Twice"});
    state.notice = Notice{"Not opened", "Lamp"};
    state.unlit = true;
    state.layout.bottomOpen = true;
    state.errors.points = {{0, 0.5, 0.1}, {1, 0.4, 0.1}};
    ExplainedPixel pixel;
    for (auto* rows : {&pixel.explanation.tables.byOrigin, &pixel.explanation.tables.bySender}) {
        const std::uint32_t group = addRow(*rows, {.label = "Lights", .value = {1, 1, 1}});
        for (std::uint32_t i = 0; i < 3; ++i)
            addRow(*rows, {LightRowKind::Light, "Lamp", i, group, {1, 1, 1}});
    }
    for (const auto& [id, object] : state.document.objects)
        if (std::holds_alternative<Light>(object))
            pixel.lights.push_back(id);
    const auto rules = lintRules();
    state.lint.findings = std::make_shared<const std::vector<Finding>>(
        std::vector<Finding>{{rules[0], Severity::Note, pixel.lights[0], "Lamp", "Twice.", "No."},
                             {rules[0], Severity::Error, pixel.lights[0], "Lamp", "Twice.", "No."},
                             {rules[1], Severity::Warning, 0, "", "Twice.", "No."}});
    state.explain.muted = {pixel.lights[0]};
    state.explain.result = std::make_shared<const ExplainedPixel>(std::move(pixel));
    state.explain.pick.emplace();
    state.explain.goals.goals.assign(3, {.wanted = 1});
    return state;
}

/// Copies of the editor with each object selected, all objects of each kind, and all, with another
/// tab open in each.
std::vector<EditorState> withEverySelection(const EditorState& crowded) {
    std::vector<EditorState> all;
    const auto add = [&](std::vector<ObjectId> selection) {
        all.push_back(crowded);
        all.back().selection = std::move(selection);
        all.back().layout.tab = BottomTab(all.size() % kBottomTabNames.size());
        all.back().explain.bySender = all.size() % 2 == 0;
    };
    std::map<std::size_t, std::vector<ObjectId>> kinds;
    std::vector<ObjectId> everything;
    for (const auto& [id, object] : crowded.document.objects) {
        add({id});
        kinds[object.index()].push_back(id);
        everything.push_back(id);
    }
    for (const auto& [kind, ids] : kinds)
        add(ids);
    add(everything);
    return all;
}

/// Copies of the editor with an object's other forms: each technique, each kind of sky, a lightmap
/// by density.
std::vector<EditorState> withEveryForm(const EditorState& crowded) {
    std::vector<EditorState> all;
    for (const auto& [id, object] : crowded.document.objects) {
        const auto add = [&](Object other) {
            all.push_back(crowded);
            all.back().document.objects.at(id) = std::move(other);
            all.back().selection = {id};
        };
        if (std::holds_alternative<TechniqueChoice>(object))
            for (const Technique* technique : techniques())
                add(TechniqueChoice{technique->name, {}});
        if (std::holds_alternative<Sky>(object))
            for (const SkyKind kind : {SkyKind::Color, SkyKind::Gradient, SkyKind::Image})
                add(Sky{.kind = kind});
        if (std::holds_alternative<BakeSettings>(object))
            add(BakeSettings{.texelsPerMetre = 4});
    }
    return all;
}

/// Copies of the editor with each overlay, comparison, workspace and dialog.
std::vector<EditorState> withEveryPanel(const EditorState& crowded) {
    std::vector<EditorState> all;
    const auto add = [&](const auto& change) {
        all.push_back(crowded);
        change(all.back());
    };
    for (const OverlayKind* kind : overlayKinds())
        add([&](EditorState& s) { s.overlay.options.kind = kind; });
    for (const Compare mode : {Compare::Reference, Compare::Difference, Compare::Flip,
                               Compare::SquaredError, Compare::Technique})
        add([&](EditorState& s) { s.compare.mode = mode; });
    for (std::size_t i = 0; i < kWorkspaceNames.size(); ++i)
        add([&](EditorState& s) { switchWorkspace(s, Workspace(i)); });
    for (const auto purpose : {FileBrowser::Purpose::NewFromScene, FileBrowser::Purpose::Open,
                               FileBrowser::Purpose::SaveAs, FileBrowser::Purpose::SkyImage,
                               FileBrowser::Purpose::AddScene, FileBrowser::Purpose::Texture,
                               FileBrowser::Purpose::SavePictures})
        add([&](EditorState& s) { openFileBrowser(s, purpose); });
    add([](EditorState& s) { s.confirm = Request{Request::Kind::Quit, {}}; });
    add([](EditorState& s) { s.recovery = RecoveryOffer{"a.limn", 0}; });
    add([](EditorState& s) { s.bake.running = true; });
    add([](EditorState& s) {
        s.errors.points.clear();
        s.layout.tab = BottomTab::Error;
    });
    add([](EditorState& s) {
        s.lint.running = true;
        s.layout.tab = BottomTab::Check;
    });
    add([](EditorState& s) { s.loading = "atrium"; });
    add([](EditorState& s) {
        openExportDialog(s);
        s.exporting.running = true;
    });
    return all;
}

TEST(ItemIds, CollideWhereTwoWidgetsOfAFrameHaveTheSame) {
    const HeadlessUi ui;
    const DrawnItems drawn;
    const auto draw = [&](const char* first, const char* second) {
        ImGui::NewFrame();
        ImGui::Begin("window");
        for (const char* label : {first, second}) {
            ImGui::Button(label);
            EXPECT_TRUE(drawn.find(ImGui::GetItemID())) << label;
        }
        ImGui::End();
        ImGui::Render();
    };
    draw("Bake", "Bake##workspace");
    EXPECT_TRUE(drawn.collisions().empty()) << drawn.collisions().front();
    draw("Bake", "Bake");
    draw("Bake", "Bake");
    EXPECT_EQ(drawn.collisions().size(), 1u) << "the same one in both frames";
}

TEST(ItemIds, NeverCollideWhereverOneClicks) {
    const TemporaryFolder folder;
    const EditorState crowded = crowdedEditor(folder);
    EditorState distant = crowded; // numbers too long for one row
    distant.document.origin = {1e6 + 32, -4e9, 48};
    Visitor visitor;
    visitor.clickEverything(crowded);
    visitor.clickEverything(emptyEditor());
    for (const auto& states : {withEverySelection(crowded), withEverySelection(distant),
                               withEveryForm(crowded), withEveryPanel(crowded)})
        for (const EditorState& start : states)
            visitor.clickEverything(start);
    for (const Action& action : actions()) {
        EditorState start = crowded;
        runAction(start, action);
        visitor.clickEverything(start);
    }
    visitor.expectNoCollisions();
    EXPECT_GT(visitor.hits, 0.99 * double(visitor.clicks)) << "the middles of few are covered";
}

} // namespace
} // namespace limn::item_ids_test
