<?php
// Lets Zabbix's own frontend check a template as its import does before it touches a database: the structure, the
// words, the keys of items. Arguments: the folder of the frontend, the template. It prints one line of JSON.

[, $root, $template] = $argv;
chdir($root);
error_reporting(E_ALL & ~E_DEPRECATED & ~E_WARNING);
require_once "$root/vendor/autoload.php";
require_once "$root/include/defines.inc.php";

$places = [];
foreach (new RecursiveIteratorIterator(new RecursiveDirectoryIterator("$root/include/classes")) as $place) {
	$places[strtolower(basename((string) $place, '.php'))] = (string) $place;
}
spl_autoload_register(function ($name) use ($places) {
	$place = $places[strtolower($name)] ?? null;
	if ($place !== null) {
		require_once $place;
	}
});

// The frontend takes these from its translations.
if (!function_exists('_')) {
	function _($text) {
		return $text;
	}
}
function _s($text, ...$arguments) {
	return vsprintf($text, $arguments);
}
function _n($one, $several, ...$arguments) {
	return vsprintf($one, $arguments);
}
function _x($text, $context) {
	return $text;
}

$found = ['faults' => [], 'items' => 0];
try {
	$read = (new CYamlImportReader())->read(file_get_contents($template));
	$checked = (new CXmlValidator(new CImportValidatorFactory('yaml'), 'yaml'))->setStrict(true)->validate($read, '/');
	$keys = new CItemKey();
	foreach ($checked['zabbix_export']['templates'] as $one) {
		foreach ($one['items'] as $item) {
			$found['items']++;
			if ($keys->parse($item['key']) !== CParser::PARSE_SUCCESS) {
				$found['faults'][] = $item['key'].': '.$keys->getError();
			}
		}
	}
}
catch (Exception $fault) {
	$found['faults'][] = $fault->getMessage();
}
echo json_encode($found), "\n";
