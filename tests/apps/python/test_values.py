import copy
import gc
import pickle

import numpy
import pytest

import runnel


@pytest.fixture
def app(xml):
    with runnel.load(xml / "apps/bug_demo.xml", speed=0) as app:
        app.run_for(1)
        yield app


def test_a_published_value_has_fields_text_equality(app):
    pose = app.read("/world/pose")
    assert pose.type.name == "Pose2" and pose.type.fields[0][:3] == ("x", "double", "m")
    assert pose.x == pose["x"] and isinstance(pose.x, float)
    assert repr(pose).startswith("Pose2 {x: ")
    assert pose == pose.copy() and pose != runnel.make("Pose2", x=99)
    assert pose != "something else"
    with pytest.raises(AttributeError, match="did you mean 'heading'"):
        pose.headin


def test_what_has_been_published_cannot_be_changed(app):
    scan = app.read("/laser/scan")
    with pytest.raises(AttributeError, match="copy"):
        scan.start_angle = 1
    with pytest.raises(ValueError, match="read-only"):
        scan.ranges[0] = 1


def test_an_array_is_no_copy_and_outlives_its_buffers(app):
    scan = app.read("/laser/scan")
    first, second = scan.ranges, scan.ranges
    assert first.__array_interface__["data"] == second.__array_interface__["data"]
    was = first.copy()
    del scan
    gc.collect()
    app.run_for(20)
    assert (first == was).all()
    assert not (app.read("/laser/scan").ranges == was).all()
    app.close()
    assert (first == was).all()


def test_pickle_and_copy(app):
    scan = app.read("/laser/scan")
    assert pickle.loads(pickle.dumps(scan)) == scan
    mine = copy.deepcopy(scan)
    mine.ranges[:] = 2.0
    mine.start_angle = 0
    assert mine != scan and mine.ranges.min() == 2.0


def test_a_value_of_ones_own():
    point = runnel.types.Point2(x=1)
    point.y = 2
    assert (point.x, point.y) == (1.0, 2.0)
    assert point.plain() == {"x": 1.0, "y": 2.0}
    assert runnel.make("Point2", "{x: 1, y: 2}") == point == runnel.make("Point2", {"x": 1, "y": 2})
    with pytest.raises(runnel.Error, match="did you mean 'x'"):
        runnel.types.Point2(xx=1)
    with pytest.raises(runnel.Error, match="did you mean 'Point2'"):
        runnel.types.Point3
    with pytest.raises(TypeError):
        point.x = [1]


def test_lists_of_structures_are_lists_and_structured_arrays():
    path = runnel.types.Path2(points=[{"x": 1, "y": 2}, runnel.types.Point2(x=3, y=4)])
    assert len(path.points) == 2 and path.points[1].x == 3 and [each.y for each in path.points] == [2, 4]
    array = path.points.array()
    assert array["x"].tolist() == [1, 3]
    with pytest.raises(IndexError):
        path.points[2]
    with pytest.raises(BufferError):
        path.points = []
    del array
    path.points = []
    assert len(path.points) == 0


def test_an_array_of_a_value_of_ones_own_never_dangles():
    scan = runnel.types.RangeScan(ranges=[1, 2, 3])
    view = scan.ranges
    with pytest.raises(BufferError):
        scan.ranges = numpy.zeros(1000)
    view[:] = 7
    assert scan.ranges.tolist() == [7, 7, 7]
    del view
    scan.ranges = numpy.arange(1000)
    assert scan.ranges[-1] == 999


def test_a_list_whose_elements_are_being_made_keeps_its_size():
    path = runnel.types.Path2()

    class Grows:
        def __float__(self):
            with pytest.raises(BufferError):
                path.points = [{"x": 7, "y": 7}] * 1000
            return 1.0

    path.points = [{"x": 1, "y": Grows()}, {"x": 2, "y": 2}]
    assert [each.y for each in path.points] == [1, 2]


def test_pictures_are_arrays():
    picture = runnel.types.Image(width=3, height=2, encoding="rgb8", row_stride=10, data=numpy.arange(20, dtype="u1"))
    array = runnel.image(picture)
    assert array.shape == (2, 3, 3) and array[1, 0].tolist() == [10, 11, 12]
    assert numpy.shares_memory(array, picture.data)
    picture.height  # the array keeps the value
    del picture
    assert array[0, 1, 0] == 3
    with pytest.raises(ValueError, match="too few"):
        runnel.image(runnel.types.Image(width=3, height=9, encoding="rgb8", row_stride=9, data=[0]))


def test_numbers_out_of_range_are_refused():
    with pytest.raises(ValueError, match="out of the range"):
        runnel.types.Image(width=-1)
    with pytest.raises(TypeError):
        runnel.types.Image(width=1.5)


def test_truth_and_names(app):
    assert app.read("/laser/scan") and runnel.make("Path2", points=[{"x": 1, "y": 2}]).points
    assert not runnel.make("Path2").points
    assert {"Pose2", "Twist2", "double"} <= set(dir(runnel.types)) and "double[]" not in dir(runnel.types)
    assert runnel.types.Pose2.names == [] and "left" not in runnel.types.Pose2.names
