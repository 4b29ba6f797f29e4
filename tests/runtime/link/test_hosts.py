"""What a link over TCP takes for a host."""

import pytest

from regscribe_runtime import tcp


@pytest.mark.parametrize("host", ["10.0.0.7:502", "tcp:10.0.0.7", "tcp:10.0.0.7:502", "tcp://oven:502", "[::1]:502"])
def test_a_host_with_a_port_or_a_scheme_is_refused(host: str) -> None:
    with pytest.raises(ValueError, match=r"is no host: give the port apart, as in tcp\('10\.0\.0\.7', port=502\)"):
        tcp(host)


@pytest.mark.parametrize(
    ("host", "name"), [("[::1]", "::1"), ("::1", "::1"), ("fe80::1%eth0", "fe80::1%eth0"), ("oven", "oven")]
)
def test_an_ipv6_address_is_a_host_in_brackets_or_without(host: str, name: str) -> None:
    assert tcp(host).name == f"tcp://{name}:502"
