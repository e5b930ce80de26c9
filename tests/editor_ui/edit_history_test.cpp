// SPDX-License-Identifier: MIT
#include "editor_ui/document/edit_history.h"

#include <gtest/gtest.h>

namespace limn::edit_history_test {
namespace {

Light named(const char* name) {
    Light light;
    light.name = name;
    return light;
}

TEST(EditHistory, UndoAndRedoOfAChangeRestoreBothValues) {
    Document document;
    const ObjectId id = addObject(document, named("a"));
    EditHistory history;
    apply(history, document, {"Rename", {{id, named("a"), named("b")}}});
    EXPECT_EQ(objectName(document.objects.at(id)), "b");
    EXPECT_TRUE(undo(history, document));
    EXPECT_EQ(objectName(document.objects.at(id)), "a");
    EXPECT_TRUE(redo(history, document));
    EXPECT_EQ(objectName(document.objects.at(id)), "b");
}

TEST(EditHistory, UndoingACreationRestoresTheWholeDocumentWithItsNextId) {
    Document document;
    addObject(document, named("a"));
    const Document before = document;
    EditHistory history;
    apply(history, document, {"Add", {{2, {}, named("b")}, {3, {}, named("c")}}});
    EXPECT_EQ(document.nextId, 4u);
    const Document after = document;
    undo(history, document);
    EXPECT_EQ(document, before);
    redo(history, document);
    EXPECT_EQ(document, after);
}

TEST(EditHistory, ANewEditDropsWhatCouldBeRedone) {
    Document document;
    EditHistory history;
    apply(history, document, {"Add a", {{1, {}, named("a")}}});
    undo(history, document);
    apply(history, document, {"Add b", {{1, {}, named("b")}}});
    EXPECT_FALSE(redo(history, document));
    EXPECT_EQ(history.edits.size(), 1u);
    EXPECT_EQ(objectName(document.objects.at(1)), "b");
}

TEST(EditHistory, AnEditWithoutChangesIsNotRecorded) {
    Document document;
    EditHistory history;
    apply(history, document, {"Nothing", {}});
    EXPECT_TRUE(history.edits.empty());
    EXPECT_FALSE(undo(history, document));
}

} // namespace
} // namespace limn::edit_history_test
