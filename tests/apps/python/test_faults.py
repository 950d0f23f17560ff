"""Whatever method of a module throws, a change is made as a whole or not at all."""

import pytest

import runnel

METHODS = ["class", "__init__", "prepare"]

WELL = '''
import runnel


class Ticker(runnel.Module):
    period = 0.02
    out = runnel.Output("int64")
    goal = runnel.Input("Twist2")
    step = runnel.Parameter(1)
    count = 0

    def prepare(self):
        pass

    @runnel.service
    def ask(self, number: int) -> int:
        return number + 1

    def update(self):
        self.count += self.step
        self.out.publish(self.count)
'''

FILE = '''<application name="robot">
  <load plugin="python"/>
  <clock type="simulated" speed="0"/> <thread name="control" period="10ms"/>
  <module name="ticker" type="python/well.Ticker"/>
  <driving port="ticker/goal"/>
</application>
'''


def failing(method):
    if method == "class":
        return WELL.replace("    count = 0\n", "    count = 1 // 0\n")
    if method == "__init__":
        return WELL.replace("    def prepare", "    def __init__(self):\n        raise OSError('no device')\n\n    def prepare")
    return WELL.replace("        pass\n", "        raise OSError('no device')\n")


@pytest.fixture
def app(empty_folder):
    (empty_folder / "well.py").write_text(WELL)
    (empty_folder / "robot.xml").write_text(FILE)
    with runnel.load(empty_folder / "robot.xml") as app:
        app.run_for(0.1)
        app.stop()
        yield app


def has_thread(app, name):
    """Whether there is one: a change that gives it the period that it has is refused else."""
    try:
        app.apply(f"schedule /threads/{name} period=20ms")
    except runnel.Error:
        return False
    app.undo()
    return True


def picture(app, folder):
    app.save(folder / "saved.xml", overwrite=True)
    return app.paths(), (folder / "saved.xml").read_text()


def goes_on(app):
    app.release()  # raises if STOP is not in force
    app.stop()
    before = app.read("/ticker/out")
    app.run_for(0.1)
    assert app.read("/ticker/out") > before + 2
    assert app.call("/ticker/ask", number=41) == 42
    assert not app.faults()


@pytest.mark.parametrize("method", METHODS)
def test_a_module_is_made_or_not(app, empty_folder, method):
    before = picture(app, empty_folder)
    (empty_folder / "new.py").write_text(failing(method))
    with pytest.raises(runnel.Error, match="no device|by zero"):
        app.create("new", "python/new.Ticker")
    assert picture(app, empty_folder) == before
    assert not has_thread(app, "python_new")
    goes_on(app)
    (empty_folder / "new.py").write_text(WELL)
    app.reload()
    app.create("new", "python/new.Ticker")
    app.run_for(0.1)
    assert app.read("/new/out") == 5
    goes_on(app)


@pytest.mark.parametrize("method", METHODS)
def test_a_module_is_made_anew_or_not(app, empty_folder, method):
    before = picture(app, empty_folder)
    (empty_folder / "well.py").write_text(failing(method))
    with pytest.raises(runnel.Error, match="no device|by zero"):
        app.reload()
    goes_on(app)
    (empty_folder / "well.py").write_text(WELL)
    assert picture(app, empty_folder) == before
    app.reload()
    goes_on(app)


@pytest.mark.parametrize("method", METHODS)
def test_a_module_is_replaced_or_not(app, empty_folder, method):
    before = picture(app, empty_folder)
    (empty_folder / "new.py").write_text(failing(method))
    with pytest.raises(runnel.Error, match="no device|by zero"):
        app.swap("/ticker", "python/new.Ticker")
    assert picture(app, empty_folder) == before
    goes_on(app)


def test_a_change_that_is_refused_leaves_no_thread(app, empty_folder):
    before = picture(app, empty_folder)
    (empty_folder / "new.py").write_text(WELL)
    with pytest.raises(runnel.Error, match="nobody"):
        app.apply("create /robot/new python/new.Ticker; delete /robot/nobody")
    assert picture(app, empty_folder) == before
    assert not has_thread(app, "python_new")
    app.create("new", "python/new.Ticker")
    app.run_for(0.1)
    assert app.read("/new/out") == 5
    goes_on(app)


def test_what_a_handler_throws_is_told_and_it_answers_the_next_time(app, empty_folder):
    (empty_folder / "well.py").write_text(WELL.replace("return number + 1", "return 42 // (number - 7)"))
    app.reload()
    app.run_for(0.1)
    with pytest.raises(runnel.Error, match="by zero"):
        app.call("/ticker/ask", number=7)
    assert app.call("/ticker/ask", number=8) == 42
