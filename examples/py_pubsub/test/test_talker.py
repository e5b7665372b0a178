from py_pubsub.talker import greeting


def test_greetings_are_numbered():
    assert greeting(3) == 'Hello World: 3'
