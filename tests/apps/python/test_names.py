"""app.read() keeps what it reads by, and names change meanwhile, by whoever it may be."""

import pytest

import runnel


class Number(runnel.Module):
    out = runnel.Output("double")
    value = runnel.Parameter(1.0)

    def update(self):
        self.out.publish(self.value)


class Looker(runnel.Module):
    """Reads by the application what has been read before, and keeps all that it has seen."""

    app = None
    seen = []
    errors = []

    def update(self):
        try:
            if Looker.app is not None:
                Looker.seen.append(Looker.app.read("/a/out"))
        except runnel.Error as error:
            Looker.errors.append(error)


@pytest.fixture
def app():
    with runnel.compose("demo", clock="simulated", control=True) as app:
        app.thread("control", 0.05)
        app.create("a", Number, value=1.0)
        app.create("b", Number, value=2.0)
        app.step(6)
        yield app


@pytest.fixture
def remote(app):
    with runnel.connect("demo") as remote:
        yield remote


def test_reads_what_has_the_name_now_whoever_has_renamed_it(app, remote):
    assert (app.read("/a/out"), app["/b/out"]) == (1, 2)
    remote.apply("rename /demo/a old; rename /demo/b a")
    app.step(6)
    assert (app.read("/a/out"), app["/a/out"], app.read("/old/out")) == (2, 2, 1)
    with pytest.raises(runnel.Error):
        app.read("/b/out")
    remote.undo()
    app.step(6)
    assert (app.read("/a/out"), app["/b/out"]) == (1, 2)
    with pytest.raises(runnel.Error):
        app["/old/out"]


def test_reads_nothing_that_somebody_has_deleted(app, remote):
    assert app.read("/a/out") == 1
    remote.delete("/a")
    with pytest.raises(runnel.Error):
        app.read("/a/out")
    remote.undo()
    app.step(6)
    assert app.read("/a/out") == 1


def test_a_parameter_that_has_the_name_now_is_no_port(app, remote):
    assert app["/a/out"] == 1
    remote.apply("rename /demo/a old")
    with pytest.raises(runnel.Error):
        app["/a/out"]
    assert app["/old/value"] == 1


def test_keeps_what_it_reads_by_as_long_as_its_name_means_that(app, remote):
    assert (app.read("/a/out"), app.read("/b/out")) == (1, 2)
    kept = dict(app._readers)
    app.create("c", Number)
    remote.swap("/b", next(type for path, _, type in app.paths("module") if path == "/demo/b"), value=3.0)
    app.step(6)
    assert (app.read("/a/out"), app.read("/b/out"), app.read("/c/out")) == (1, 3, 1)
    assert {path: app._readers[path] for path in kept} == kept


def test_a_module_reads_on_while_others_change_what_there_is():
    with runnel.compose("demo", clock="real", control=True) as app, runnel.connect("demo") as remote:
        app.thread("control", 0.001)
        app.create("a", Number, value=1.0)
        app.create("looker", Looker)
        Looker.seen, Looker.errors = [], []
        reader = app.reader("/a/out")
        app.start()
        assert reader.wait(30)
        assert app.read("/a/out") == 1
        Looker.app = app
        try:
            for number in range(5):
                remote.apply(f"create group /demo/group{number}; rename /demo/group{number} other{number}")
                before = len(Looker.seen)
                while len(Looker.seen) < before + 3 and not Looker.errors:
                    assert reader.wait(30)
            assert not Looker.errors and set(Looker.seen) == {1}
            remote.apply("rename /demo/a old")
            while not Looker.errors:
                assert reader.wait(30)
                reader.read()
            assert "not waited for in update()" in str(Looker.errors[0])
        finally:
            Looker.app = None
