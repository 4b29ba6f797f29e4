from regscribe.import_csv import read

FLAGS = b'address,name,access,kind,type,bits\n1,Alarms,r,%s,%s,"{""0"": ""first""}"\n'


def test_rows_that_differ_in_their_model_alone_are_one_register_of_these_models() -> None:
    text, findings = read(b"address,name,access,model\n1,Gain,rw,A\n1,Gain,rw,B\n2,Bias,rw,B\n", "table.csv")
    assert findings == ()
    assert text.count("name: Gain") == 1
    assert "{at: 1, name: Gain, access: rw}" in text
    assert "{at: 2, name: Bias, access: rw, models: [B]}" in text


def test_a_register_without_a_group_is_one_of_the_group_that_is_named_for_it() -> None:
    text, _ = read(b"address,name,access,model,group\n1,Gain,rw,A,\n1,Gain,rw,B,Registers\n", "table.csv")
    assert text.count("name: Gain") == 1
    assert "models: [" not in text


def test_flags_of_many_words_have_a_length() -> None:
    text, findings = read(FLAGS % (b"flags", b"uint80"), "table.csv")
    assert findings == ()
    assert "{at: 1, name: Alarms, access: r, length: 5, flags: {0: first}}" in text
    for kind, wire in ((b"flags", b"uint81"), (b"integer", b"uint80")):
        _, findings = read(FLAGS % (kind, wire), "table.csv")
        assert any(wire.decode() in one.message for one in findings)
